"""Create classes for rospy from the text of a definition, without a build, files or changes to sys.modules.

genpy.dynamic can compile only messages. For each message, it leaves a module and a folder. This module runs
the code from genpy's generator in a separate namespace.
"""

from __future__ import annotations

import re
from threading import Lock
from types import SimpleNamespace
from typing import Any

import rospkg
from genmsg.base import InvalidMsgSpec, MsgGenerationException
from genmsg.gentools import compute_full_text, compute_md5
from genmsg.msg_loader import MsgContext, load_depends, load_msg_from_string, load_srv_from_string
from genmsg.msgs import MsgSpec, bare_msg_type, is_builtin, resolve_type
from genmsg.srvs import SrvSpec
from genpy.generator import make_python_safe, msg_generator

from course_pkg.errors import BrokenDefinition
from course_pkg.types.definition import lines, with_unix_line_ends
from course_pkg.types.diagnosis import validate
from course_pkg.types.fields import MessageClass, ServiceClass
from course_pkg.types.search_path import (
    DefinitionKind,
    built_message,
    definition_file,
    read_definition,
    split_type_name,
)

# Only one thread may use genpy's generator, because the generator stores its state in global variables.
_GENERATOR = Lock()
_IMPORT = re.compile(r"import \w+\.msg")


def compiled_service(name: str, text: str, source: str, strict: bool = False) -> ServiceClass:
    """Return the class of a service.

    Raises BrokenDefinition if the definition has a mistake, and UnknownType if the name is invalid.
    """
    package, short = split_type_name(name)
    generation = _Generation()
    spec = generation.load_service(name, text, source, strict)
    attributes = {
        "__module__": f"{package}.srv",
        "_type": name,
        "_md5sum": compute_md5(generation.context, spec),
        "_request_class": generation.message(spec.request, source),
        "_response_class": generation.message(spec.response, source),
        "_dependencies": generation.classes,
    }
    # mypy does not know the attributes of a class that type() creates.
    made: Any = type(short, (), attributes)
    checked: ServiceClass = made
    return checked


def compiled_message(name: str, text: str, source: str, strict: bool = False) -> MessageClass:
    """Return the class of a message.

    Raises BrokenDefinition if the definition has a mistake, and UnknownType if the name is invalid.
    """
    generation = _Generation()
    return generation.message(generation.load_message(name, text, source, strict), source)


def dependency(cls: MessageClass, name: str) -> MessageClass:
    """Return the class of the message type `name`, which is the type of a field of this class."""
    full = "std_msgs/Header" if name in ("Header", "roslib/Header") else name
    found: MessageClass | None = getattr(cls, "_dependencies", {}).get(full) or built_message(full)
    assert found is not None
    return found


class _Generation:
    """Generates one type, and the message types that it depends on.

    `classes` contains the classes of the dependencies. If a dependency is built and its definition has not
    changed since the build, its class is the built class. Otherwise, its class is new.
    """

    def __init__(self) -> None:
        self.context = MsgContext.create_default()
        self.classes: dict[str, MessageClass] = {}
        self._finder = rospkg.RosPack()

    def load_service(self, name: str, text: str, source: str, strict: bool) -> SrvSpec:
        """Return the specification of a service; its dependencies are loaded and generated."""
        text = self._validated(name, text, source, "srv", strict)
        try:
            spec: SrvSpec = load_srv_from_string(self.context, text, name)
        except (InvalidMsgSpec, ValueError) as error:
            raise _refused(source, text, error) from error
        for message in (spec.request, spec.response):
            self._require(message, source, (name,))
        load_depends(self.context, spec, {})
        return spec

    def load_message(
        self, name: str, text: str, source: str, strict: bool = False, within: tuple[str, ...] = ()
    ) -> MsgSpec:
        """Return the specification of a message.

        `within` lists the types that contain the message, the outermost type first.
        """
        text = self._validated(name, text, source, "msg", strict)
        try:
            spec: MsgSpec = load_msg_from_string(self.context, text, name)
        except (InvalidMsgSpec, ValueError) as error:
            raise _refused(source, text, error) from error
        self._require(spec, source, (*within, name))
        load_depends(self.context, spec, {})
        return spec

    def _validated(self, name: str, text: str, source: str, kind: DefinitionKind, strict: bool) -> str:
        package, _ = split_type_name(name)
        text = with_unix_line_ends(text)
        validate(text, source, package, kind, self._exists, strict)
        return text

    def message(self, spec: MsgSpec, source: str) -> MessageClass:
        """Return the class of a loaded message."""
        full_text = compute_full_text(self.context, spec)
        try:
            namespace = {"__name__": f"{spec.package}.msg", **self._packages()}
            exec(compile(self._code(spec), f"<{spec.full_name}>", "exec"), namespace)  # noqa: S102 - genpy's code
        except (SyntaxError, MsgGenerationException) as error:
            raise _refused(source, spec.text, error) from error
        cls: Any = namespace[spec.short_name]  # The generated class has no static type.
        cls._full_text = full_text
        cls._dependencies = self.classes
        for constant in make_python_safe(spec).constants:
            setattr(cls, constant.name, constant.val)
        generated: MessageClass = cls
        return generated

    def _code(self, spec: MsgSpec) -> str:
        """Return genpy's code for a message.

        The method removes import statements, and strings that genpy does not escape.
        """
        with _GENERATOR:
            pieces = list(msg_generator(self.context, spec, {}))
        copied = ("  _full_text = ", *(f"  {each.name} = " for each in make_python_safe(spec).constants))
        return "\n".join(each for each in pieces if not (_IMPORT.fullmatch(each) or each.startswith(copied)))

    def _packages(self) -> dict[str, SimpleNamespace]:
        """Return a namespace for each package in the code.

        For example, the namespace `geometry_msgs` contains `msg.Point`.
        """
        packages: dict[str, SimpleNamespace] = {}
        for name, cls in self.classes.items():
            package, short = split_type_name(name)
            messages = packages.setdefault(package, SimpleNamespace(msg=SimpleNamespace())).msg
            setattr(messages, short, cls)
            setattr(messages, f"_{short}", SimpleNamespace(**{short: cls}))
        return packages

    def _require(self, spec: MsgSpec, source: str, within: tuple[str, ...]) -> None:
        """Generate the message types of a message's fields, if they have not been generated yet."""
        for type_name in spec.types:
            name = resolve_type(bare_msg_type(type_name), spec.package)
            if is_builtin(name) or name in self.classes:
                continue
            if name in within:
                raise _circle(source, spec.text, type_name, (*within[within.index(name) :], name))
            self._add(name, within)

    def _add(self, name: str, within: tuple[str, ...]) -> None:
        text, source = self._text(name)
        spec = self.load_message(name, text, source, within=within)
        built = built_message(name)
        if built and built._md5sum == compute_md5(self.context, spec):
            self.classes[name] = built
        else:
            self.classes[name] = self.message(spec, source)

    def _text(self, name: str) -> tuple[str, str]:
        if file := definition_file(name, "msg", self._finder):
            return read_definition(file), str(file)
        built = built_message(name)
        assert built is not None
        return built._full_text.split("\n" + "=" * 80 + "\n")[0], f"{name}.msg"

    def _exists(self, name: str) -> bool:
        return bool(definition_file(name, "msg", self._finder) or built_message(name))


def _circle(source: str, text: str, type_name: str, chain: tuple[str, ...]) -> BrokenDefinition:
    short = bare_msg_type(type_name).rpartition("/")[2]
    line = next(each for each in lines(text) if short in each.code)
    problem = f"{chain[0]} would contain itself ({' → '.join(chain)})"
    return BrokenDefinition(source, line.number, 1, line.text, problem, "remove this field")


def _refused(source: str, text: str, error: Exception) -> BrokenDefinition:
    """Return the error for a definition that the module `diagnosis` accepts, but genmsg or genpy refuses."""
    first = text.split("\n", maxsplit=1)[0]
    return BrokenDefinition(
        source, 1, 1, first, f"ROS refuses it: {error}", "compare it with wiki.ros.org/msg"
    )
