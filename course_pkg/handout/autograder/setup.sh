#!/bin/sh
# Gradescope runs this script as root when it builds the image of the autograder. It installs the course in a
# folder that other users can read, except for the solutions and the checks.
set -eu
umask 022
here=$(dirname -- "$(readlink -f -- "$0")")
course=/opt/ros-services-course
mkdir -p "$course"
cp -R "$here/course/." "$course/"
chmod -R u+rwX,go+rX,go-w "$course"
export HOME=/root XDG_CACHE_HOME=/var/cache
"$course/course" autograde --prepare
