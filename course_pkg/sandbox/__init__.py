"""The sandbox in which submissions run.

Each part runs in a new process, forked from a process that has imported all modules.

    course grade                    outside the sandbox; trusts only the records of check runners
    └─ bwrap                        no network, no home, no solutions, a read-only root
       └─ worker.py                 trusted; imports all checks, and forks a check runner for each part
          ├─ check_process.py       the check runner, in the part's network; only its record earns points
          └─ fork_server.py         imports no checks, and cannot read them; forks for each part
             └─ supervisor.py       has a network, a hostname and a work folder only for this part
                ├─ master           on the usual port
                ├─ command_runner.py  runs the check's commands; the student's kernel cannot change them
                └─ student_process.py  the answer: no privileges, its own users and processes, limited memory

users.py offers a weaker sandbox for machines that forbid namespaces.

All processes of a sandbox exchange JSON. Messages from `student_process.py` are shown as feedback, but they
are never trusted.
"""
