"""A drawing as a figure of a document: the whole, or the part in a box."""

from __future__ import annotations

from io import BytesIO

import numpy as np
import pytest
from doors import Drawing, DrawingView, Stroke
from PIL import Image


def drawing() -> Drawing:
    made = Drawing(100.0, 60.0, "Plan")
    made.add(Stroke((10 + 10j, 30 + 10j)), Stroke((70 + 50j, 90 + 50j)))
    return made


@pytest.mark.parametrize("box", [None, (5.0, 5.0, 45.0, 25.0)])
def test_each_format_is_as_large_as_the_view(
    box: tuple[float, float, float, float] | None,
) -> None:
    view = DrawingView(drawing(), box)
    width, height = (100.0, 60.0) if box is None else (40.0, 20.0)
    assert view.size == (width, height)
    assert f'viewBox="0 0 {width:g} {height:g}"' in view.svg() and view.svg().startswith("<svg")
    pixels = Image.open(BytesIO(view.png(254.0)))
    assert pixels.size == (10 * width, 10 * height)
    assert np.asarray(pixels).min() < 50


def test_items_outside_the_box_are_left_out() -> None:
    shown = DrawingView(drawing(), (5.0, 5.0, 45.0, 25.0)).crop()
    assert shown.items == [Stroke((5 + 5j, 25 + 5j))]
