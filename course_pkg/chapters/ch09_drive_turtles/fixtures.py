"""The cells that run before and after an answer of chapter 09 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
from pathlib import Path

from course_pkg import join

node = join("chapter_09")
scripts = Path("src/my_turtles/scripts")
scripts.mkdir(parents=True, exist_ok=True)
Path("src/my_turtles/launch").mkdir(exist_ok=True)
for name in ("spawn_turtle", "pubvel_toggle", "pubvel_toggle_plus", "improved_pubvel_toggle", "spawn_turtle_plus"):
    script = scripts / f"{name}.py"
    script.touch()
    script.chmod(0o755)
