"""Compile a roscpp program, and inspect it: it must not start another program.

A program can hide a call that starts another program. Therefore, require_no_other_program() also examines the
files that the program's processes execute.
"""

from __future__ import annotations

import re
import shlex

from course_pkg.checking.commands.folder import Folder, Running
from course_pkg.checking.context import CheckContext
from course_pkg.errors import CheckError, ToolMissing
from course_pkg.workspace import Fault, explain
from course_pkg.workspace.cpp_support import compile_command

COMPILES = "the compiler accepts the file"
ITSELF = "the C++ program does the work itself"
STARTS_ANOTHER = "The program contains a call that can start another program. Use only functions of roscpp."

# This pattern matches an undefined symbol in the output of `readelf`. An undefined symbol is a name that the
# program uses and a library defines.
CALLED = re.compile(r"\sUND\s+([A-Za-z_]\w*)")
STARTS = re.compile(
    r"f?exec[lv]\w*|posix_spawnp?|v?fork|clone\d?|system|popen|dlm?open|syscall|mprotect|memfd_create"
)
NEEDED = re.compile(r"\(NEEDED\)[^\[]*\[(lib\w+)\.so")
# These machine instructions of x86 and ARM processors make a system call without a library function.
INSTRUCTION = r"[[:space:]](syscall|sysenter|svc)([[:space:]]|$)|int +[$]0x80"
# At most this number of lines of readelf's output is read; a usual program has about 400 symbols.
LINES = 2000


def compile_roscpp(
    context: CheckContext, folder: Folder, file: str, program: str, *, limits: str, within: float
) -> None:
    """Compile a file in the folder, and assert that the result is a roscpp program.

    `limits` is a bash command that limits the resources of the compiler, such as `ulimit`. Raises CheckError
    if the compiler takes longer than the time limit `within` (s).
    """
    line = f"{limits}; exec {shlex.join(compile_command(file, program))}"
    done = folder.command("bash", "-c", line, within=within, worded=f"the compiler, at {file}")
    if done.status is None:
        raise CheckError(
            f"The compiler had not finished after {done.took:.0f} s, because the machine is busy. "
            "Run this cell again."
        )
    if done.status != 0:
        fault = explain(done.err + done.out) or Fault("the compiler ended without a message", "")
        context.fail(
            COMPILES,
            expected="a program",
            actual=f"line {fault.line}: {fault.problem}" if fault.line else fault.problem,
            hint=fault.remedy,
        )
    context.require(COMPILES, holds=True)
    require_roscpp(context, folder, program)


def require_roscpp(context: CheckContext, folder: Folder, program: str) -> None:
    """Assert that the file `program` is a compiled roscpp program that starts no other program.

    The file is in the folder `folder`.

    C++ code can start another program with exec(3). A CMakeLists.txt can write a script in place of the
    compiled program. Raises ToolMissing if binutils is missing; binutils is usually installed with a
    compiler. A report shows these assertions only if they fail.
    """
    path = shlex.quote(program)
    seen = folder.command(
        "bash", "-c", f"readelf --dynamic --dyn-syms --wide {path} | head -n {LINES}", worded="readelf"
    )
    if "readelf" in seen.err and "not found" in seen.err:
        raise ToolMissing(
            "The program readelf is not installed. On Debian and Ubuntu: apt-get install binutils."
        )
    if "roscpp" not in {name.removeprefix("lib") for name in NEEDED.findall(seen.out)}:
        context.fail(
            "the program is a compiled C++ program that uses roscpp",
            expected="an ELF file that is linked with libroscpp",
            actual=(seen.out + seen.err).strip().partition("\n")[0] or "a file of another type",
            hint=(
                "The program does not use roscpp. Build the program from C++ code that calls "
                "functions of roscpp."
            ),
        )
    starts = sorted({name for name in CALLED.findall(seen.out) if STARTS.fullmatch(name)})
    hidden = folder.command(
        "bash",
        "-c",
        f"objdump --disassemble --no-show-raw-insn {path} | grep --count --extended-regexp '{INSTRUCTION}'",
        worded="objdump",
    )
    if starts or hidden.out.strip() != "0":
        context.fail(
            ITSELF,
            expected="no call that starts another program or loads a library",
            actual=f"calls of {', '.join(starts)}" if starts else "a direct system call",
            hint=STARTS_ANOTHER,
        )
    folder.only = folder.command("sha256sum", program).out.partition(" ")[0]


def require_no_other_program(context: CheckContext, running: Running) -> None:
    """Assert that the processes of `running` execute only the compiled program of their folder.

    The assertion also fails if an earlier call of Running.examine() has found another file.
    """
    running.examine()
    if running.other:
        context.fail(
            ITSELF,
            expected="a process that executes only the compiled program",
            actual=f"a process that executes {running.other}",
            hint=STARTS_ANOTHER,
        )
