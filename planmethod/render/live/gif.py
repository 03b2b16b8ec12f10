"""Frames as a GIF (растровая анимация)."""

from __future__ import annotations

from io import BytesIO

from PIL import Image

from planmethod.render.backends import render
from planmethod.render.backends.canvas import Options
from planmethod.render.live.animation import Animation

_GREYS = 8  # levels of grey with which the edges of black lines are smooth


def gif(animation: Animation, seconds: float, dpi: float) -> bytes:
    """Return a GIF that repeats endlessly, ``seconds`` a cycle."""
    options = Options(dpi=dpi)
    levels = [round(255 * k / (_GREYS - 1)) for k in range(_GREYS)]
    table = [min(range(_GREYS), key=lambda k: abs(levels[k] - grey)) for grey in range(256)]
    frames = []
    for drawing in animation.frames():
        with Image.open(BytesIO(render(drawing, "png", options=options))) as picture:
            frame = picture.convert("L").point(table)
        frame = Image.frombytes("P", frame.size, frame.tobytes())
        frame.putpalette([level for grey in levels for level in (grey,) * 3])
        frames.append(frame)
    file = BytesIO()
    # Viewers count hundredths of a second, and slow down frames shorter than two of them.
    each = max(2, round(100 * seconds / len(frames))) * 10
    frames[0].save(
        file, "gif", save_all=True, append_images=frames[1:], duration=each, loop=0, optimize=False
    )
    return file.getvalue()
