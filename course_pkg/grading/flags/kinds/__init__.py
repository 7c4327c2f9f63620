"""One module for each kind of flag; `find(group)` yields the flags of a chapter's work.

The name of the module is the name of the kind, for `course grade --flags`. `TITLE` is the heading of the kind
in class.html. A new module in this folder is found by itself.
"""
