"""Whatever clients send, the node lives and its world makes sense."""

from __future__ import annotations

import pytest

from course_pkg.graph import NodeProcess, PrivateMaster
from tests.kernel import Kernel


@pytest.mark.parametrize("seed", [1, 2])
def test_bad_clients_do_no_harm(seed: int, master: PrivateMaster, kernel: Kernel) -> None:
    """After 400 random deeds turtle1 starts from the middle and obeys; bench/turtle_fuzz.py does 10,000."""
    with NodeProcess(["rosrun", "turtlesim", "turtlesim_node"]) as simulator:
        simulator.wait_for_service("/spawn")
        refused = kernel.run(
            f"""
            from course_pkg import join
            from tests.turtlesim.fuzz import Fuzzer, sane
            node = join("fuzz")
            fuzzer = Fuzzer(node, {seed})
            for _ in range(400):
                fuzzer.step()
            sane(node)
            result = fuzzer.refused
            """,
            patience=100,
        )
        assert refused > 20
        assert simulator.running
