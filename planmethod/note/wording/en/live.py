"""Words of the page of a moving mechanism in English (живая страница по-английски)."""

from planmethod.note.wording.live_model import LiveWording

LIVE = LiveWording(
    play="Play",
    pause="Pause",
    driver="Position of the driving link",
    speed="speed",
    traces="paths",
    touch="Point at a segment or touch it.",
    choose="A symbol in the table below adds or removes its diagram; a touch of a diagram sets the "
    "driving link there.",
    diagrams="Diagrams",
    numbers="Exact values",
    forces="Reactions and what balances the driving link",
    no_place="There is no such position: point {point} cannot be placed.",
    dead="Dead position: the rays of the plan do not meet.",
    no_forces="The force plan does not close: a dead position.",
    unknown="A load is given in the positions of the file only: no forces between them.",
    nearest="The nearest that exist:",
    steady="Angular velocity of the crank in the steady motion of the machine",
    follows="moves as {speed}",
    zoom="picture ×{times}",
    made="Made by planmethod live from the problem file; the values are computed here, from the "
    "same steps as the drawings. Millimetres are those of the sheet at the scale given.",
)
