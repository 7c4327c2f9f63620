"""A picture in the notebook, with words for those who cannot see it."""

from __future__ import annotations

import base64
import html
from typing import Any

from course_pkg.panels.image.png import png


class ImageView:
    """A picture and its description; it stays what it was when it was made, and is stored with a notebook."""

    def __init__(self, data: bytes, width: int, height: int, description: str) -> None:
        self.data = data
        self.description = description
        self._width, self._height = width, height

    def _repr_mimebundle_(self, **_: object) -> tuple[dict[str, Any], dict[str, Any]]:
        """Return the picture as HTML, which holds the description, and as PNG, where no HTML is trusted."""
        code = base64.b64encode(self.data).decode()
        alt, size = html.escape(self.description), f'width="{self._width}" height="{self._height}"'
        picture = f'<img src="data:image/png;base64,{code}" alt="{alt}" {size}>'
        data = {"text/html": picture, "image/png": code, "text/plain": repr(self)}
        return data, {"image/png": {"width": self._width, "height": self._height, "alt": self.description}}

    def __repr__(self) -> str:
        return f"[{self.description}]"


def show_image(image: Any, description: str = "") -> ImageView:  # noqa: ANN401 -- a class that genpy generates
    """Show a sensor_msgs/Image; `description` says in words what is in it. Raises NotAnImage."""
    data = png(image)
    words = description or f"a picture of {image.width} x {image.height} points"
    return ImageView(data, image.width, image.height, words)
