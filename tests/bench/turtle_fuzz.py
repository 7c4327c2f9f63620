"""10,000 random calls and messages for the simulator: `./course run python tests/bench/turtle_fuzz.py`.

Prints whether the node lives, whether its world makes sense, and how its memory went.
"""

from __future__ import annotations

import argparse
import time

from course_pkg.graph import NodeProcess, join
from tests.turtlesim.fuzz import Fuzzer, resident, sane

BLOCKS = 10


def main() -> None:
    """Fuzz in ten blocks, and look after each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--deeds", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    node = join("fuzz")
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as simulator:
        simulator.wait_for_service("/spawn")
        fuzzer = Fuzzer(node, options.seed)
        for block in range(1, BLOCKS + 1):
            started = time.monotonic()
            for _ in range(options.deeds // BLOCKS):
                fuzzer.step()
            sane(node)
            took, memory = time.monotonic() - started, resident(simulator.pid)
            done = block * options.deeds // BLOCKS
            print(
                f"{done:6} deeds, {fuzzer.refused} calls refused, {took:.1f} s, {memory:.1f} MiB", flush=True
            )
    print("the node lived, and its world made sense after each block")


if __name__ == "__main__":
    main()
