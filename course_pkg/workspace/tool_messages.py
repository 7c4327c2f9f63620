"""The errors of catkin, genmsg and the tools of ROS about a package.

The rows of the tables have the same columns as in the module cmake_messages.
"""

from __future__ import annotations

from course_pkg.workspace.cmake_messages import Row

FROM_BUILD: tuple[Row, ...] = (
    (
        r'from catkin_pkg\.package import parse_package" failed',
        "",
        "The build uses the first Python on PATH, but ROS is installed for a different Python.",
        "Build with catkin_make -DPYTHON_EXECUTABLE=/usr/bin/python3. If you correct PATH "
        "instead, also remove the folder build.",
    ),
    (
        r"The manifest contains invalid XML:\s*mismatched tag: line (?P<line>\d+)",
        "package.xml",
        "In this line or above, a tag is not closed, or the closing tag has a different name.",
        "Close every <tag> with </tag>.",
    ),
    (
        r"The manifest contains invalid XML:\s*(?P<what>[^\n]*?): line (?P<line>\d+)",
        "package.xml",
        "The file is not valid XML: {what}.",
        "Write <?xml in the first column of line 1, and close every tag. Use straight quotes, "
        "and write &amp; instead of &.",
    ),
    (
        r"The manifest .*?\(with format version (?P<format>\d)\) "
        r"must not contain the following tags: (?P<tags>[^\n]+)",
        "package.xml",
        "A package.xml of format {format} cannot have the tag {tags}.",
        "In formats 2 and 3, use the tags buildtool_depend, build_depend, depend, or exec_depend in place of "
        "run_depend, and check the spelling.",
    ),
    (
        r'must contain (?:exactly|at least) one "(?P<tag>\w+)" tag',
        "package.xml",
        "The tag {tag} is missing, or the file contains this tag twice.",
        "Write <{tag}>…</{tag}> exactly once.",
    ),
    (
        r"generic dependency on .(?P<name>\w+). is redundant with: (?P<tags>\w+)",
        "package.xml",
        "{name} is listed twice: in <depend> and in <{tags}>.",
        "Keep only <depend>, which means both <build_depend> and <exec_depend>.",
    ),
    (
        r"must declare at least one maintainer",
        "package.xml",
        "The package has no maintainer.",
        'Write <maintainer email="you@example.com">You</maintainer>.',
    ),
    (
        r'The "(?P<tag>\w+)" tag must have the attribute "(?P<name>\w+)"',
        "package.xml",
        "The tag {tag} has no attribute {name}.",
        'Write <{tag} {name}="…">.',
    ),
    (
        r'Invalid email "(?P<email>[^"]*)"',
        "package.xml",
        "{email} is not an e-mail address of the form name@example.com.",
        "Write a whole e-mail address, such as you@example.com.",
    ),
    (
        r'Package name "(?P<package>[^"]*)" does not follow naming conventions',
        "package.xml",
        "{package} is not a valid name for a package.",
        "In the name of the package, use only lower-case letters, digits and _. The first character has to "
        "be a letter.",
    ),
    (
        r'Package version "(?P<version>[^"]*)" does not follow version conventions',
        "package.xml",
        "The version {version} does not consist of three numbers with dots between them.",
        "Write the version as in this example: 0.1.0.",
    ),
    (
        r"Multiple packages found with the same name \"(?P<name>[^\"]+)\"",
        "",
        "Two folders below src contain a package with the name {name}.",
        "Move one of the two folders out of src, or change the name of the package in <name> "
        "and in project().",
    ),
    (
        r"package name '(?P<name>[^']+)' is illegal and cannot be used in message generation",
        "package.xml",
        "{name} cannot be the name of a package with messages, because the name is not valid "
        "for a Python module.",
        "In package.xml and in project(), use a name that begins with a letter and "
        "contains only lower-case letters, digits and _.",
    ),
    (
        r"InvalidMsgSpec'?>?: Invalid declaration: (?P<text>[-\N{EN DASH}\N{EM DASH}][^\n]*)",
        "",
        "A .srv file contains the line {text!s} instead of the three dashes.",
        "Write a line that contains only ---.",
    ),
    (
        r"InvalidMsgSpec'?>?: Invalid declaration: (?P<text>[^\n]*)",
        "",
        "A .srv file contains the line {text}. A field needs a type, one space, and a name.",
        "Write the field as in this example: float32 length.",
    ),
    (
        r"InvalidMsgSpec'?>?: (?P<what>[^\n]*)",
        "",
        "A .srv file cannot be read: {what}.",
        "Correct the wrong line in the .srv file. rossrv show prints the same error, with the "
        "name of the type.",
    ),
    (
        r"base path \"(?P<path>[^\"]+)\" contains a package",
        "",
        "catkin_make was started inside a package.",
        "Go to the root of the workspace, which is the folder that contains src, and start "
        "catkin_make there.",
    ),
    (
        r"specified source space \"(?P<path>[^\"]+)\" does not exist",
        "",
        "catkin_make was started in a folder that does not contain src.",
        "Go to the root of the workspace, which is the folder that contains src, and start "
        "catkin_make there.",
    ),
)

FROM_TOOLS: tuple[Row, ...] = (
    (
        r"\[rospack\] Error: package '(?P<name>[^']+)' not found|"
        r"unknown package \[(?P<other>\w+)\] on search path",
        "",
        "No package {name}{other} is on ROS_PACKAGE_PATH.",
        (
            "In this shell, type `source devel/setup.bash` in the folder of the package's workspace. "
            "Also check the spelling of the package's name."
        ),
    ),
    (
        r"No module named '(?P<name>\w+)\.(?:srv|msg)'",
        "",
        "Python finds the package {name}, but this package has no generated types.",
        "Look for generate_messages and add_service_files in CMakeLists.txt, and build again.",
    ),
    (
        r"No module named '(?P<name>numpy|matplotlib)'",
        "",
        "The library {name} is not installed for the Python that runs the program.",
        "Write #!/usr/bin/env python3 as the first line. This line selects the Python in which "
        "the library is installed.",
    ),
    (
        r"No module named '(?P<name>\w+)'",
        "",
        "Python cannot find the package {name}.",
        "Type `source devel/setup.bash` in the folder of the package's workspace. If this does not help, "
        "look for generate_messages in the CMakeLists.txt of the package.",
    ),
    (
        r"cannot import name '(?P<name>\w+)' from '(?P<module>[\w.]+)'",
        "",
        "The module {module} does not contain {name}.",
        "Compare {name} with the name of the .srv file. ROS and Python distinguish capital and small "
        "letters.",
    ),
    (
        r"Couldn't find executable named (?P<name>\S+) below",
        "",
        "The package has no program {name}.",
        "Make the file executable with chmod +x. If the file is already executable, compare its name "
        "with the name in your command, including the ending.",
    ),
    (
        r"(?:import|from): command not found|syntax error near unexpected token"
        r"|import(?:-im\d\S*)?: unable to open X server",
        "",
        "The shell executed the Python script as a shell script.",
        "Write #!/usr/bin/env python3 as the first line of the script.",
    ),
    (
        r"env: .python3?\\r.: No such file",
        "",
        "The script has Windows line endings, so the name python3 in line 1 ends with an extra character.",
        "Convert the script to Linux line endings: sed -i 's/\\r$//' FILE.",
    ),
    (
        r"\[(?P<name>[^\]]+)\] is neither a launch file in package",
        "",
        "roslaunch starts launch files, but {name} is not a launch file.",
        "Start a single program with rosrun.",
    ),
    (
        r"RLException: Invalid roslaunch XML syntax",
        "",
        "roslaunch expects a launch file, which is XML, but this file is not XML.",
        "Start a single program with rosrun.",
    ),
    (
        r"(?P<tool>ros\w+) args\tprint service arguments|Usage: (?P<other>ros\w+) ",
        "",
        "{tool}{other} does not know this command. The output of {tool}{other} lists all commands.",
        "Use one of the commands in the output. For example, rossrv show prints the fields of a type.",
    ),
)
