"""Tests of the node `polled_camera`, which takes a picture for each call."""

from __future__ import annotations

import os
import signal
from collections.abc import Iterator

import pytest
import rospy
from course_pkg.srv import LetIn, PolledImage, PolledImageResponse

from course_pkg.ros import BoundedProxy, MasterClient, NodeProcess, PrivateMaster
from course_pkg.shop import shop_picture
from tests.support import eventually, terminal

pytestmark = pytest.mark.usefixtures("master")


@pytest.fixture
def camera() -> Iterator[NodeProcess]:
    """Run `rosrun course_pkg polled_camera` without other nodes."""
    with NodeProcess(["rosrun", "course_pkg", "polled_camera"]) as process:
        process.wait_for_service("/request_image")
        yield process


def take(width: int = 0, height: int = 0) -> PolledImageResponse:
    """Call the camera's service, and return its response."""
    return BoundedProxy("/request_image", PolledImage)(width, height)


@pytest.mark.usefixtures("camera")
@pytest.mark.parametrize(
    ("asked", "size"), [((0, 0), (320, 240)), ((64, 0), (64, 240)), ((17, 33), (17, 33))]
)
def test_a_picture_has_the_requested_size(asked: tuple[int, int], size: tuple[int, int]) -> None:
    """The picture has the requested size. If the requested size is 0, the picture has the default size."""
    taken = take(*asked)
    image = taken.image
    assert (image.width, image.height, image.step, image.encoding) == (*size, 3 * size[0], "rgb8")
    assert image.data == shop_picture(*size, taken.customers)
    assert abs(rospy.Time.from_sec(image.header.stamp.to_sec()).to_sec() - image.header.stamp.to_sec()) < 1


@pytest.mark.usefixtures("camera")
@pytest.mark.parametrize(
    ("asked", "words"),
    [((15, 0), "width: 15 does not fit"), ((0, 1281), "height"), ((2**32 - 1, 1), "width")],
)
def test_an_impossible_size_is_refused(asked: tuple[int, int], words: str) -> None:
    """If the requested size is outside the limits, the error message contains these limits."""
    with pytest.raises(rospy.ServiceException, match=f"{words}.*expected 16 to 1280 points"):
        take(*asked)
    assert take().image.data


@pytest.mark.usefixtures("camera")
def test_a_picture_shows_the_customers_at_the_counter() -> None:
    """The picture shows the customers who were added with the service of the node shop_camera."""
    with NodeProcess(["rosrun", "course_pkg", "shop_camera"]) as shop:
        shop.wait_for_service("/let_in")
        for customers in (0, 3, 5):
            BoundedProxy("/let_in", LetIn)(after=[0.0] * (customers - take().customers), stay=600.0)
            eventually(lambda wanted=customers: take().customers == wanted)
    assert 0 <= take().customers <= 5


def test_even_the_first_picture_shows_the_customers() -> None:
    """If customers are present when the camera starts, the first picture shows these customers."""
    with NodeProcess(["rosrun", "course_pkg", "shop_camera"]) as shop:
        shop.wait_for_service("/let_in")
        BoundedProxy("/let_in", LetIn)(after=[0.0] * 9, stay=600.0)
        with NodeProcess(["rosrun", "course_pkg", "polled_camera"]) as camera:
            camera.wait_for_service("/request_image")
            assert take().customers == 9


def test_the_camera_can_publish_a_stream() -> None:
    """With `_stream:=30`, the camera publishes pictures and still responds to calls."""
    with NodeProcess(["rosrun", "course_pkg", "polled_camera", "_stream:=30"]) as process:
        process.wait_for_service("/request_image")
        heard = terminal("rostopic", "echo", "-n", "2", "--noarr", "/image")
        assert heard.stdout.count("width: 320") == 2
        assert take().image.width == 320


@pytest.mark.parametrize("settings", [[], ["_stream:=30"]])
def test_an_interrupt_ends_the_camera(settings: list[str], master: PrivateMaster) -> None:
    """After SIGINT, the camera unregisters and exits without a traceback."""
    with NodeProcess(["rosrun", "course_pkg", "polled_camera", *settings]) as process:
        process.wait_for_service("/request_image")
        os.kill(process.pid, signal.SIGINT)
        assert process.wait(5) == 0
        assert "Traceback" not in process.output()
    assert MasterClient(master.uri).system_state().nodes == ()
