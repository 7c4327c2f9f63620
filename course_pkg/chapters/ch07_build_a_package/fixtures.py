"""The cells that run before and after an answer of chapter 07 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
from pathlib import Path

from course_pkg import join

node = join("chapter_07")

# %% 07.4 before
script = Path("src/my_geometry/scripts/server.py")
if not script.exists():
    script.parent.mkdir(parents=True, exist_ok=True)
    script.touch(0o755)

# %% 07.5 before
script = Path("src/my_geometry/scripts/client.py")
if not script.exists():
    script.parent.mkdir(parents=True, exist_ok=True)
    script.touch(0o755)

# %% 07.9 before
script = Path("src/service_example/scripts/on_off_server.py")
if not script.exists():
    script.parent.mkdir(parents=True, exist_ok=True)
    script.touch(0o755)

# %% 07.10 before
script = Path("src/service_example/scripts/on_off_client.py")
if not script.exists():
    script.parent.mkdir(parents=True, exist_ok=True)
    script.touch(0o755)
