"""One module for each kind of flag; `find(group)` yields the flags for the students' work on a chapter.

The name of a module in this folder is the name of a kind of flag in `course grade --flags`. `TITLE` is the
heading of this kind of flag in class.html. The course uses each module in this folder; a new module does not
have to be registered.
"""
