"""One module for each kind of flag; `find(group)` yields the flags for the students' work on a chapter.

The name of the module is the name of the kind in `course grade --flags`. `TITLE` is the heading of this kind
in class.html. The course uses each module in this folder; a new module does not have to be registered.
"""
