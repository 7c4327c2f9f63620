"""What catkin, genmsg and the tools of ROS say of a package; rows as in cmake_table."""

from __future__ import annotations

from course_pkg.building.cmake_table import Row

FROM_BUILD: tuple[Row, ...] = (
    (
        r'from catkin_pkg\.package import parse_package" failed',
        "",
        "The build runs another Python than the one that ROS is installed for: it comes first on PATH.",
        "Build with catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3. The folder build remembers the other "
        "one, so that mending PATH alone is not enough: remove build, too.",
    ),
    (
        r"The manifest contains invalid XML:\s*mismatched tag: line (?P<line>\d+)",
        "package.xml",
        "A tag is not closed, or closed by another name, in this line or above it.",
        "Close every <tag> by </tag>.",
    ),
    (
        r"The manifest contains invalid XML:\s*(?P<what>[^\n]*?): line (?P<line>\d+)",
        "package.xml",
        "It is no XML: {what}.",
        "Begin with <?xml in the first column of the first line, close every tag, use straight quotes, and "
        "write &amp; for &.",
    ),
    (
        r"The manifest .*?\(with format version (?P<format>\d)\) "
        r"must not contain the following tags: (?P<tags>[^\n]+)",
        "package.xml",
        "Format {format} has no tag {tags}.",
        "Formats 2 and 3 have buildtool_depend, build_depend, exec_depend and depend; compare the spelling.",
    ),
    (
        r'must contain (?:exactly|at least) one "(?P<tag>\w+)" tag',
        "package.xml",
        "The tag {tag} is missing, or there twice.",
        "Write <{tag}>…</{tag}> once.",
    ),
    (
        r"generic dependency on .(?P<name>\w+). is redundant with: (?P<tags>\w+)",
        "package.xml",
        "{name} is named by depend, and by {tags} once more.",
        "Keep depend, which is both to build and to run.",
    ),
    (
        r"must declare at least one maintainer",
        "package.xml",
        "Nobody is named as the maintainer.",
        'Write <maintainer email="you@example.com">You</maintainer>.',
    ),
    (
        r'The "(?P<tag>\w+)" tag must have the attribute "(?P<name>\w+)"',
        "package.xml",
        "The tag {tag} lacks its {name}.",
        'Write <{tag} {name}="…">.',
    ),
    (
        r'Invalid email "(?P<email>[^"]*)"',
        "package.xml",
        "{email} is no address of the form name@example.com.",
        "Write a whole address; you@example.com will do.",
    ),
    (
        r'Package name "(?P<package>[^"]*)" does not follow naming conventions',
        "package.xml",
        "The name {package} does not do for a package.",
        "Write it in lower-case letters, digits and _, with a letter first, and no blanks.",
    ),
    (
        r'Package version "(?P<version>[^"]*)" does not follow version conventions',
        "package.xml",
        "The version {version} is not three numbers with dots between.",
        "Write it as in 0.1.0.",
    ),
    (
        r"Multiple packages found with the same name \"(?P<name>[^\"]+)\"",
        "",
        "Two folders below src say that they are {name}.",
        "Move one of them out of src, or give it another <name> and project().",
    ),
    (
        r"package name '(?P<name>[^']+)' is illegal and cannot be used in message generation",
        "package.xml",
        "{name} cannot be the name of a package with messages: it becomes the name of a Python module.",
        "Use lower-case letters, digits and _, and a letter first, in package.xml and in project().",
    ),
    (
        r"InvalidMsgSpec'?>?: Invalid declaration: (?P<text>[-\N{EN DASH}\N{EM DASH}][^\n]*)",
        "",
        "A .srv file has the line {text!s} where three dashes belong.",
        "Write --- and nothing else.",
    ),
    (
        r"InvalidMsgSpec'?>?: Invalid declaration: (?P<text>[^\n]*)",
        "",
        "A .srv file has the line {text}, which is no type and name with one blank between.",
        "Write it as in: float32 length.",
    ),
    (
        r"InvalidMsgSpec'?>?: (?P<what>[^\n]*)",
        "",
        "A .srv file cannot be read: {what}.",
        "Mend that line. rossrv show says the same, and names the type.",
    ),
    (
        r"base path \"(?P<path>[^\"]+)\" contains a package",
        "",
        "catkin_make was started in a package.",
        "Go up to the root of the workspace, the folder that holds src, and start it there.",
    ),
    (
        r"specified source space \"(?P<path>[^\"]+)\" does not exist",
        "",
        "catkin_make was started where there is no folder src.",
        "Go to the root of the workspace, the folder that holds src, and start it there.",
    ),
)

FROM_TOOLS: tuple[Row, ...] = (
    (
        r"\[rospack\] Error: package '(?P<name>[^']+)' not found|"
        r"unknown package \[(?P<other>\w+)\] on search path",
        "",
        "No package {name}{other} is on ROS_PACKAGE_PATH.",
        "Source devel/setup.bash of its workspace in this shell, and compare the spelling.",
    ),
    (
        r"No module named '(?P<name>\w+)\.(?:srv|msg)'",
        "",
        "Python finds the package {name}, and no types in it: they were not generated.",
        "Look for generate_messages and add_service_files in CMakeLists.txt, and build again.",
    ),
    (
        r"No module named '(?P<name>\w+)'",
        "",
        "Python finds no {name} on its path.",
        "Source devel/setup.bash of its workspace; if that is done, look for generate_messages there.",
    ),
    (
        r"cannot import name '(?P<name>\w+)' from '(?P<module>[\w.]+)'",
        "",
        "{module} has no {name}.",
        "Compare it with the name of the .srv file: upper and lower case differ.",
    ),
    (
        r"Couldn't find executable named (?P<name>\S+) below",
        "",
        "The package has no program {name}.",
        "Give the file its run bit: chmod +x. If it has that, compare the name, its ending too.",
    ),
    (
        r"(?:import|from): command not found|syntax error near unexpected token",
        "",
        "The shell took the Python script for one of its own.",
        "Make #!/usr/bin/env python3 its first line.",
    ),
    (
        r"env: .python3?\\r.: No such file",
        "",
        "The lines of the script end as on Windows: the shebang asks for a python3 with a mark behind it.",
        "Save it with the line ends of Linux: sed -i 's/\\r$//' FILE.",
    ),
    (
        r"\[(?P<name>[^\]]+)\] is neither a launch file in package",
        "",
        "roslaunch starts launch files, and {name} is none.",
        "Start a single program by rosrun.",
    ),
    (
        r"RLException: Invalid roslaunch XML syntax",
        "",
        "roslaunch took the file for a launch file, which is XML, and it is none.",
        "Start a single program by rosrun.",
    ),
    (
        r"(?P<tool>ros\w+) args\tprint service arguments|Usage: (?P<other>ros\w+) ",
        "",
        "{tool}{other} does not know that command, and says which it knows.",
        "Take one of those. What a type is made of, rossrv show says; who serves a name, rosservice info.",
    ),
)
