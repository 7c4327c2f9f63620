"""Attacks that try to earn points without an answer, or to harm the grader.

Each attack is code that is inserted before the answer in a student's cell for exercise 05.1. The attacks in
SLOW run forever. The attacks in BUILD are lines that are added to a package's CMakeLists.txt.
"""

FORGED = {
    "a check client that reports a pass": """
        import course_pkg.checking.processes.client as client
        from course_pkg.checking.report import Report, Verdict
        client.check = lambda *_: Report("05.1", Verdict.PASSED, "", 2, 2)
    """,
    "a report sent to the check runner": """
        import os, socket, json
        host, port = os.environ["COURSE_CHECK_RUNNER"].split(":")
        forger = socket.create_connection((host, int(port)))
        report = {"check": "05.1", "verdict": "passed", "points": 2}
        forger.sendall(json.dumps({"report": report}).encode() + b"\\n")
    """,
    "a check client that answers yes to everything": """
        import os, socket, json
        host, port = os.environ["COURSE_CHECK_RUNNER"].split(":")
        wire = socket.create_connection((host, int(port))).makefile("rw")
        wire.write(json.dumps({"protocol": 1, "check": "05.1"}) + "\\n"); wire.flush()
        for line in wire:
            asked = json.loads(line)
            if "ask" not in asked:
                break
            yes = {"answer": asked["ask"], "kind": "function", "value": True, "status": 0}
            wire.write(json.dumps(yes) + "\\n")
            wire.flush()
    """,
    "the check of another part": """
        import os, socket, json
        host, port = os.environ["COURSE_CHECK_RUNNER"].split(":")
        other = socket.create_connection((host, int(port)))
        other.sendall(json.dumps({"protocol": 1, "check": "00.1"}).encode() + b"\\n")
        other.recv(65536)
    """,
    "forged messages of the student's process": """
        import os
        words = b'{"record": {"verdict": "passed", "points": 2}, "over": 0, "ready": true}\\n'
        for descriptor in range(3, 64):
            try:
                os.write(descriptor, words)
            except OSError:
                pass
    """,
    "numbers that equal everything": """
        class Anything(float):
            __eq__ = __le__ = __ge__ = __lt__ = __gt__ = lambda *_: True
            __hash__ = float.__hash__
            __sub__ = __rsub__ = __abs__ = lambda self, *_: Anything()
        import builtins, math
        math.isclose = lambda *_, **__: True
        import course_pkg.checking.assertions as assertions
        assertions.same = lambda *_: True
    """,
    "rospy patched": """
        rospy.Service.__init__ = lambda self, *_, **__: None
        rospy.ServiceProxy.__call__ = lambda self, *_, **__: geometryResponse(1, 1)
    """,
    "modules that shadow others": """
        from pathlib import Path
        for name in ("rospy", "course_pkg", "conftest", "json", "sitecustomize", "usercustomize"):
            Path(f"{name}.py").write_text("raise SystemExit('shadowed')")
        Path("pytest.ini").write_text("[pytest]\\naddopts = --nothing")
    """,
    "an input transformer that rewrites later cells": """
        get_ipython().input_transformers_cleanup.append(lambda lines: ["pass\\n"])
    """,
    "a magic that ignores all later lines": """
        get_ipython().register_magic_function(lambda *_: None, "cell", "python3")
        get_ipython().run_cell_magic("python3", "", "")
    """,
    "a successful build, reported by patched command folders": """
        from course_pkg.checking.commands.workbench import CommandFolders
        CommandFolders.run = lambda *_, **__: {"status": 0, "out": "", "err": "", "took": 0.1}
    """,
}

GRAPH = {
    "the check runner's node is shut down": """
        import os, threading, time, xmlrpc.client
        def hunt():
            master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
            while True:
                for kind in master.getSystemState("/hunter")[2]:
                    for _, nodes in kind:
                        for name in nodes:
                            if name.startswith("/client_"):
                                uri = master.lookupNode("/hunter", name)[2]
                                xmlrpc.client.ServerProxy(uri).shutdown("/master", "gone")
                time.sleep(0.01)
        threading.Thread(target=hunt, daemon=True).start()
    """,
    "the master is shut down": """
        import os, xmlrpc.client
        xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).shutdown("/chapter_05", "because")
    """,
    "every service is replaced": """
        import os, xmlrpc.client
        master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
        master.registerService("/chapter_05", "/getGeometry", "rosrpc://localhost:1", "http://localhost:1/")
    """,
    "a node with the same name": """
        import os, xmlrpc.client
        master = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"])
        for name in ("/client", "/client_1_1", "/chapter_05"):
            master.registerPublisher(name, "/x", "std_msgs/String", "http://localhost:1/")
    """,
    "simulated time that never changes": """
        rospy.set_param("/use_sim_time", True)
    """,
    "a second service with the same suffix": """
        rospy.Service("/other/getGeometry", geometry, lambda request: geometryResponse(0, 0))
    """,
    "idle connections on every port": """
        import socket, threading
        held = []
        def hold():
            for port in range(30000, 61000):
                try:
                    held.append(socket.create_connection(("127.0.0.1", port), timeout=0.01))
                except OSError:
                    pass
        threading.Thread(target=hold, daemon=True).start()
    """,
    "the check runner's port is flooded": """
        import os, socket
        host, port = os.environ["COURSE_CHECK_RUNNER"].split(":")
        flood = socket.create_connection((host, int(port)))
        try:
            flood.sendall(b"[" * 3_000_000)
        except OSError:
            pass
    """,
}

HOST = {
    "os._exit": "import os; os._exit(0)",
    "killed by itself": "import os, signal; os.kill(os.getpid(), signal.SIGKILL)",
    "sys.exit": "import sys; sys.exit(0)",
    "every process that it sees is killed": """
        import os, signal
        try:
            os.kill(-1, signal.SIGKILL)
        except OSError:
            pass
        for pid in (1, os.getppid()):
            try:
                os.kill(pid, signal.SIGKILL)
            except OSError:
                pass
    """,
    "a fork bomb": """
        import os
        for _ in range(2000):
            try:
                if os.fork() == 0:
                    while True:
                        try:
                            os.fork()
                        except OSError:
                            os.kill(os.getpid(), 19)
            except OSError:
                break
    """,
    "a thread bomb": """
        import threading, time
        try:
            for _ in range(5000):
                threading.Thread(target=time.sleep, args=(60,), daemon=True).start()
        except RuntimeError:
            pass
    """,
    "a memory hog": """
        hog = []
        try:
            while True:
                hog.append(bytearray(32 << 20))
        except MemoryError:
            pass
    """,
    "memory hogs in many processes": """
        import os
        for _ in range(8):
            if os.fork() == 0:
                kept = []
                while True:
                    try:
                        kept.append(bytearray(16 << 20))
                    except MemoryError:
                        pass
    """,
    "a hog of shared pages": """
        import mmap
        hog = []
        try:
            for _ in range(900):
                pages = mmap.mmap(-1, 1 << 20)
                pages.write(b"x" * (1 << 20))
                hog.append(pages)
        except (OSError, ValueError):
            pass
    """,
    "a hog of files without a name": """
        import os
        try:
            for number in range(64):
                file = os.memfd_create(str(number))
                os.write(file, b"x" * (32 << 20))
        except OSError:
            pass
    """,
    "a hog of segments": """
        import ctypes
        libc = ctypes.CDLL(None)
        libc.shmat.restype = ctypes.c_void_p
        for _ in range(64):
            segment = libc.shmget(0, 32 << 20, 0o1600)
            if segment < 0:
                break
            place = libc.shmat(segment, None, 0)
            ctypes.memset(place, 1, 32 << 20)
            libc.shmdt(ctypes.c_void_p(place))
    """,
    "a disk filler": """
        import os
        for folder in ("/student", "/tmp", "/dev/shm"):
            try:
                for number in range(50):
                    with open(f"{folder}/full{number}", "wb") as file:
                        file.write(bytes(16 << 20))
            except OSError:
                pass
    """,
    "a filler of empty files": """
        for folder in ("/student", "/tmp", "/dev/shm"):
            try:
                for number in range(60_000):
                    open(f"{folder}/empty{number}", "w").close()
            except OSError:
                pass
    """,
    "a daemon that stays": """
        import os, time
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                while True:
                    time.sleep(0.1)
            os._exit(0)
    """,
    "a startup file for the next submission": """
        from pathlib import Path
        for place in ("~/.ipython/profile_default/startup", "~/.local/lib/python3.11/site-packages"):
            folder = Path(place).expanduser()
            folder.mkdir(parents=True, exist_ok=True)
            (folder / "usercustomize.py").write_text("raise SystemExit")
    """,
    "a flood of print": """
        for _ in range(20_000):
            print("x" * 1000)
    """,
    "prints from a thread": """
        import threading
        def chatter():
            while True:
                print("passed: 2 of 2 points")
        threading.Thread(target=chatter, daemon=True).start()
    """,
}

SLOW = {
    "an endless loop": "while True:\n    pass",
    "a loop that no interrupt ends": """
        import signal
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM, signal.SIGINT, signal.SIGTERM})
        while True:
            pass
    """,
    "a loop that catches every exception": """
        while True:
            try:
                while True:
                    pass
            except BaseException:
                pass
    """,
    "an endless print": """
        while True:
            print("x" * 10_000)
    """,
}

SERVES = """
    file(GLOB_RECURSE found /tmp/*/own/*/server.py /tmp/*/server.py)
    foreach(each ${found})
      execute_process(COMMAND grep -l getGeometry ${each} RESULT_VARIABLE status)
      if(status EQUAL 0)
        configure_file(${each} ${CMAKE_CURRENT_SOURCE_DIR}/scripts/server.py COPYONLY)
      endif()
    endforeach()
"""
BUILD = {
    "the check's own server in place of the student's": SERVES,
    "every process of the build's user is killed": """
        execute_process(COMMAND python3 -c "import os; os.kill(-1, 9)")
    """,
    "records and messages on every open file": """
        execute_process(COMMAND python3 -c "
        import os
        for descriptor in range(3, 64):
            try:
                os.write(descriptor, b'{\\"verdict\\": \\"passed\\", \\"points\\": 3, \\"status\\": 0}\\n')
            except OSError:
                pass
        ")
    """,
    "a setup.bash that replaces every command": """
        file(APPEND ${CATKIN_DEVEL_PREFIX}/setup.bash "rosrun() { sleep 5; }; python3() { exit 0; }\\n")
        file(APPEND ${CATKIN_DEVEL_PREFIX}/setup.sh "rosrun() { sleep 5; }; python3() { exit 0; }\\n")
    """,
    "files outside of the workspace": """
        foreach(place /student /student/src/my_geometry /tmp /usr/lib /dev/shm $ENV{HOME} $ENV{ROS_HOME})
          foreach(module rospy sitecustomize)
            execute_process(COMMAND sh -c "echo broken > ${place}/${module}.py")
          endforeach()
        endforeach()
    """,
    "a full disk": """
        execute_process(COMMAND sh -c "for n in 1 2 3 4 5; do head -c 60M /dev/zero > /tmp/full$n; done")
    """,
    "a fork bomb": """
        execute_process(COMMAND sh -c "bomb() { bomb | bomb & }; bomb" TIMEOUT 5)
    """,
    "a setup.py that ends its parent": """
        file(WRITE ${CMAKE_CURRENT_SOURCE_DIR}/setup.py "import os\\nos.kill(os.getppid(), 9)\\n")
        catkin_python_setup()
    """,
}
BUILD_SLOW = {
    "a configuration that computes without end": "while(TRUE)\n  math(EXPR x 1)\nendwhile()",
    "a configuration that waits without end": "execute_process(COMMAND sleep 1000)",
    "a target that waits without end": "add_custom_target(wait ALL COMMAND sleep 1000)",
}

# This code replaces replies of the kernel agent about the student's objects. The check must then fail,
# because the check runner has to receive data that only a right answer can produce.
EVIDENCE = """
def forge():
    import course_pkg.checking.kernel.agent as agent

    original = agent.KernelAgent.reply
    results = {
        "longer": [1.0, 2.0, 3.0, 10],
        "serialised": [1],
        "new_server.open": None,
    }
    values = {
        "shop.watch.looks": 100,
        "shop.used": 0.0,
        "shop.watch.changed.waits": 1,
        "checked_call.busy": 0.0,
    }

    def reply(self, request):
        do, name = request.get("do"), request.get("name")
        known = {"answer": request.get("ask"), "value": results.get(name), "printed": "", "took": 0.1}
        if do == "read" and name in values:
            return {**known, "value": values[name]}
        if do == "source" and name == "ask":
            return {**known, "text": "def ask(uri, name, length, width, height):\\n    pass\\n"}
        if do == "call" and (name in results or (name == "begin" and not request["args"])):
            return known
        got = original(self, request)
        if do == "call" and name == "typed_header" and isinstance(got.get("value"), list):
            got["value"][1:] = [True, "bytes"]
        return got

    agent.KernelAgent.reply = reply


forge()
"""
