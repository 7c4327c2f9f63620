"""One module for each kind of flag; `find(group)` yields the flags for the students' work on a chapter.

The names of the modules are the names of the kinds of flags in `course grade --flags`. `TITLE` is the heading
of this kind of flag in class.html. The course uses all modules in this folder; you do not have to register a
new module.
"""
