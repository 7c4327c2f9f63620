"""The cells that run before and after an answer of chapter 04 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
from course_pkg import join

node = join("chapter_04")

# %% 04.1 before
from pathlib import Path

Path("src/lamp_services/srv").mkdir(parents=True, exist_ok=True)

# %% 04.2 before
import genmsg


def md5_of(text):
    context = genmsg.MsgContext.create_default()
    definition = genmsg.msg_loader.load_srv_from_string(context, text, "my_services/Any")
    return genmsg.compute_md5(context, definition)

# %% 04.5 before
from pathlib import Path

script = Path("src/lamp_services/scripts/lamp_server.py")
script.parent.mkdir(parents=True, exist_ok=True)
script.touch()
script.chmod(0o755)
