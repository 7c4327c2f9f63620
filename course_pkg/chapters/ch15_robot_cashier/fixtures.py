"""The cells that run before and after an answer of chapter 15 if it is examined without its notebook.

See checking/fixtures.py.
"""

# %% before
from pathlib import Path

from course_pkg import join

node = join("chapter_15")
package = Path("src/my_cashier")
for folder in ("scripts", "launch"):
    (package / folder).mkdir(parents=True, exist_ok=True)
for name in ("vision", "customer_detector", "ask_customer", "robot_cashier", "till"):
    script = package / f"scripts/{name}.py"
    script.touch()
    script.chmod(0o755)

# %% 15.11 before
RESPAWNING = """\
<launch>
  <arg name="wait" default="2.0" />
  <arg name="hardware" default="true" />
  <node if="$(arg hardware)" pkg="course_pkg" type="counter_camera" name="counter_camera" />
  <node if="$(arg hardware)" pkg="course_pkg" type="robot" name="robot" />
  <node if="$(arg hardware)" pkg="course_pkg" type="receipt_printer" name="receipt_printer" />
  <node pkg="my_cashier" type="vision.py" name="vision" respawn="true" />
  <node pkg="my_cashier" type="customer_detector.py" name="customer_detector" respawn="true" />
  <node pkg="my_cashier" type="robot_cashier.py" name="robot_cashier" respawn="true">
    <param name="wait" value="$(arg wait)" />
  </node>
  <node pkg="my_cashier" type="till.py" name="till" respawn="true" />
</launch>
"""


def change_node(name, lines):
    """Write a launch file, and the course's node `name` with additional lines that add a mistake."""
    (package / "launch/cashier.launch").write_text(RESPAWNING)
    module = f"course_pkg.chapters.ch15_robot_cashier.programs.{name}"
    start = f'if __name__ == "__main__":\n    {name}.main()\n'
    script = package / f"scripts/{name}.py"
    script.write_text(f"#!/usr/bin/env python3\nfrom {module.rpartition('.')[0]} import {name}\n\n{lines}\n\n{start}")
    script.chmod(0o755)


for name in ("vision", "customer_detector", "robot_cashier", "till"):
    (package / f"scripts/{name}.py").unlink()
