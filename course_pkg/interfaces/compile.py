"""Classes that rospy accepts, from the text of a definition: no build, no file, no entry in sys.modules.

genpy.dynamic does messages only, and leaves a module and a folder behind for each. Here genpy's
generator writes the code, and it runs in a namespace of its own.
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
from genmsg.msgs import bare_msg_type, is_builtin, resolve_type
from genpy.generator import make_python_safe, msg_generator

from course_pkg.errors import BrokenDefinition
from course_pkg.interfaces.definition import lines, unix
from course_pkg.interfaces.diagnosis import validate
from course_pkg.interfaces.path import Half, built_class, definition_file, read_definition, split

# genpy's generator keeps its state in module globals.
_GENERATOR = Lock()
_IMPORT = re.compile(r"import \w+\.msg")


def compiled_service(name: str, text: str, source: str, strict: bool = False) -> Any:  # noqa: ANN401 - a class
    """Return the class of a service. Raises BrokenDefinition, UnknownType for an impossible name."""
    package, short = split(name)
    generation = _Generation()
    spec = generation.load(name, text, source, "srv", strict)
    attributes = {
        "__module__": f"{package}.srv",
        "_type": name,
        "_md5sum": compute_md5(generation.context, spec),
        "_request_class": generation.message(spec.request, source),
        "_response_class": generation.message(spec.response, source),
        "_dependencies": generation.classes,
    }
    return type(short, (), attributes)


def compiled_message(name: str, text: str, source: str, strict: bool = False) -> Any:  # noqa: ANN401 - a class
    """Return the class of a message. Raises BrokenDefinition, UnknownType for an impossible name."""
    generation = _Generation()
    return generation.message(generation.load(name, text, source, "msg", strict), source)


def dependency(cls: Any, name: str) -> Any:  # noqa: ANN401 - generated classes
    """Return the class of a message that is a field in a message of class `cls`."""
    full = "std_msgs/Header" if name in ("Header", "roslib/Header") else name
    return getattr(cls, "_dependencies", {}).get(full) or built_class(full, "msg")


class _Generation:
    """The making of one type: what it depends on, and the classes of that.

    `classes` holds those that are built, and new ones for those that are not or
    whose text has changed since.
    """

    def __init__(self) -> None:
        self.context = MsgContext.create_default()
        self.classes: dict[str, Any] = {}
        self._finder = rospkg.RosPack()

    def load(
        self,
        name: str,
        text: str,
        source: str,
        half: Half,
        strict: bool = False,
        within: tuple[str, ...] = (),
    ) -> Any:  # noqa: ANN401 - a genmsg specification
        """Return the specification of a text, with all that it depends on loaded and generated."""
        package, _ = split(name)
        text = unix(text)
        validate(text, source, package, half, self._exists, strict)
        load: Any = load_srv_from_string if half == "srv" else load_msg_from_string
        try:
            spec = load(self.context, text, name)
        except (InvalidMsgSpec, ValueError) as error:
            raise _refused(source, text, error) from error
        for message in (spec.request, spec.response) if half == "srv" else (spec,):
            self._require(message, source, (*within, name))
        load_depends(self.context, spec, {})
        return spec

    def message(self, spec: Any, source: str) -> Any:  # noqa: ANN401 - a specification to a class
        """Return the class of a loaded message."""
        full_text = compute_full_text(self.context, spec)
        try:
            namespace = {"__name__": f"{spec.package}.msg", **self._packages()}
            exec(compile(self._code(spec), f"<{spec.full_name}>", "exec"), namespace)  # noqa: S102 - genpy's code
        except (SyntaxError, MsgGenerationException) as error:
            raise _refused(source, spec.text, error) from error
        cls: Any = namespace[spec.short_name]
        cls._full_text = full_text
        cls._dependencies = self.classes
        for constant in make_python_safe(spec).constants:
            setattr(cls, constant.name, constant.val)
        return cls

    def _code(self, spec: Any) -> str:  # noqa: ANN401 - a genmsg specification
        """Return genpy's code for a message, without imports, and without what genpy copies in unescaped."""
        with _GENERATOR:
            pieces = list(msg_generator(self.context, spec, {}))
        copied = ("  _full_text = ", *(f"  {each.name} = " for each in make_python_safe(spec).constants))
        return "\n".join(each for each in pieces if not (_IMPORT.fullmatch(each) or each.startswith(copied)))

    def _packages(self) -> dict[str, SimpleNamespace]:
        """Return what the code knows as `geometry_msgs`, with its `msg.Point`."""
        packages: dict[str, SimpleNamespace] = {}
        for name, cls in self.classes.items():
            package, short = split(name)
            messages = packages.setdefault(package, SimpleNamespace(msg=SimpleNamespace())).msg
            setattr(messages, short, cls)
            setattr(messages, f"_{short}", SimpleNamespace(**{short: cls}))
        return packages

    def _require(self, spec: Any, source: str, within: tuple[str, ...]) -> None:  # noqa: ANN401 - a specification
        for type_name in spec.types:
            name = resolve_type(bare_msg_type(type_name), spec.package)
            if is_builtin(name) or name in self.classes:
                continue
            if name in within:
                raise _circle(source, spec.text, type_name, (*within[within.index(name) :], name))
            self._add(name, within)

    def _add(self, name: str, within: tuple[str, ...]) -> None:
        text, source = self._text(name)
        spec = self.load(name, text, source, "msg", within=within)
        built = built_class(name, "msg")
        if built and built._md5sum == compute_md5(self.context, spec):
            self.classes[name] = built
        else:
            self.classes[name] = self.message(spec, source)

    def _text(self, name: str) -> tuple[str, str]:
        if file := definition_file(name, "msg", self._finder):
            return read_definition(file), str(file)
        own: str = built_class(name, "msg")._full_text.split("\n" + "=" * 80 + "\n")[0]
        return own, f"{name}.msg"

    def _exists(self, name: str) -> bool:
        return bool(definition_file(name, "msg", self._finder) or built_class(name, "msg"))


def _circle(source: str, text: str, type_name: str, chain: tuple[str, ...]) -> BrokenDefinition:
    short = bare_msg_type(type_name).rpartition("/")[2]
    line = next(each for each in lines(text) if short in each.code)
    problem = f"{chain[0]} would contain itself ({' → '.join(chain)})"
    return BrokenDefinition(source, line.number, 1, line.text, problem, "part this circle")


def _refused(source: str, text: str, error: Exception) -> BrokenDefinition:
    """Return the error for what genmsg or genpy refuses and the diagnosis let through."""
    first = text.split("\n", maxsplit=1)[0]
    return BrokenDefinition(
        source, 1, 1, first, f"ROS refuses it: {error}", "compare it with wiki.ros.org/msg"
    )
