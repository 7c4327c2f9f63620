"""Where submissions run: a warm process behind walls forks what a part needs; nothing is imported twice.

    course grade                    outside of every wall; trusts nothing but records
    └─ bwrap                        no network, no home, no solutions, a root that cannot be written
       └─ main.py                   trusted; has the checks imported, and forks a judge for each part
          ├─ judge                  in the part's network; its record alone earns points
          └─ nursery.py             has never seen a check, and cannot read one; forks for each part
             └─ leader.py           a network, a hostname and a work folder of the part's own
                ├─ master           on the usual port
                ├─ errands.py       the judge's commands, run where the student's kernel cannot reach them
                └─ student.py       no privileges, its own users, processes and memory limits: the answer

What crosses a wall is JSON, and what comes from `student.py` is shown as feedback and never believed.
"""
