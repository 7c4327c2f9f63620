"""The sandbox in which submissions run. A process that has everything imported is forked for each part.

    course grade                    outside the sandbox; believes nothing but the records of check runners
    └─ bwrap                        no network, no home, no solutions, a root that cannot be written
       └─ worker.py                 trusted; has the checks imported, and forks a check runner for each part
          ├─ check_process.py       the check runner, in the part's network; only its record earns points
          └─ fork_server.py         has imported no check, and cannot read one; forks for each part
             └─ supervisor.py       with a network, a hostname and a work folder for this part only
                ├─ master           on the usual port
                ├─ command_runner.py  runs the check's commands, where the student's kernel cannot reach them
                └─ student_process.py  the answer: no privileges, its own users and processes, limited memory

What crosses a boundary is JSON. What comes from `student_process.py` is shown as feedback and never believed.
"""
