"""Remarks of the norm control in English (нормоконтроль по-английски)."""

from planmethod.note.wording.control_model import ControlWording, Said

CONTROL = ControlWording(
    remarks={
        "PM-D01": Said(
            "inscriptions overlap",
            "'{one}' and '{two}' overlap at {place}",
            {
                "": "Take a larger format (--paper) or another scale, so that the letters have "
                "room.",
            },
        ),
        "PM-D02": Said(
            "inscription on a line",
            "'{shown}' lies on {thing} at {place}, {value} mm of it",
            {
                "": "Take a larger format (--paper) or another scale, so that the letters have "
                "room.",
            },
        ),
        "PM-D03": Said(
            "text outside its cell",
            "'{shown}' leaves its cell by {value} mm at {place}",
            {
                "": "Shorten the text, or take smaller letters.",
            },
        ),
        "PM-D04": Said(
            "text outside the frame",
            "'{shown}' leaves the frame by {value} mm at {place}",
            {
                "": "Take a larger format (--paper) or a coarser scale.",
            },
        ),
        "PM-D05": Said(
            "letters too small",
            "'{shown}' of '{whole}' is {value} mm high, less than {limit} mm, at {place}",
            {
                "": "Take letters of {limit} mm or more; a larger format where there is no room.",
            },
        ),
        "PM-D06": Said(
            "text shortened",
            "'{shown}' was shortened to fit its cell at {place}",
            {
                "": "Write a shorter text into [stamp] or --stamp.",
            },
        ),
        "PM-D07": Said(
            "view outside the frame",
            "lines leave the frame by {value} mm, furthest at {place}",
            {
                "": "Take a coarser scale in {scales} or a larger format (--paper).",
            },
        ),
        "PM-D08": Said(
            "short segments of a plan",
            "segments shorter than {limit} mm: {segments}; the first at {place}",
            {
                "": "Take a scale that draws the plan {times} times larger or more.",
                "scale": "Write {key} = {scale} into [scales]: the segments are then {limit} mm "
                "or longer, and the plan fits {paper}.",
                "own": "It needs the scale {key} = {scale}, but such a plan does not fit {paper}: "
                "draw it apart at a scale of its own, or take a larger format (--paper).",
                "nothing": "In this position the vector is nearly zero, and no scale shows it: "
                "write '≈ 0' beside the plan, or take another position (--phi).",
            },
        ),
        "PM-D09": Said(
            "no scale inscription",
            "there is no inscription of the scale '{scale} = …' under the view at {place}",
            {
                "": "Write '{scale} = …' with its unit under the name of the view.",
            },
        ),
        "PM-D10": Said(
            "unused paper",
            "an empty rectangle of {width} × {height} mm takes {value} % of the field, its middle "
            "at {place}",
            {
                "": "Take a larger scale in {scales} or a smaller format (--paper).",
            },
        ),
        "PM-D11": Said(
            "a dashed line ends in a gap",
            "{thing} does not begin and end with a stroke, {value} mm are wanting, at {place}",
            {
                "": "Begin and end the line with a stroke.",
            },
        ),
        "PM-D12": Said(
            "dashes not shown",
            "{thing}, {value} mm long, is shorter than {limit} mm and looks solid, at {place}",
            {
                "": "Take a larger scale or format, or write beside the line that it is dashed.",
            },
        ),
        "PM-D13": Said(
            "runs into a graph",
            "lines or inscriptions run {value} mm into the title block or graph 26 at {place}",
            {
                "": "Take a coarser scale in {scales} or a larger format (--paper).",
            },
        ),
        "PM-D14": Said(
            "letter misleads",
            "the letter {name} stands {value} mm from its own arrow or point (at most {limit}), "
            "{place}",
            {
                "": "Take a larger scale or format, so that the letter stands at its own arrow.",
            },
        ),
        "PM-D15": Said(
            "arrow of a turn in the way",
            "the arrow {name} lies on {thing} or nearer than {limit} mm, {place}",
            {
                "": "Take a larger scale or format, so that the arrows have room.",
            },
        ),
        "PM-D16": Said(
            "inscriptions read as one",
            "'{one}' and '{two}' stand together and read as one, {place}",
            {
                "": "Take a larger scale or format, so that there are {limit} mm between them.",
                "bar": "Take a larger scale or format: a line makes a fraction of them now.",
            },
        ),
    },
    severities={
        "error": "error",
        "warning": "warning",
    },
    place="({x}, {y}) mm",
    views={
        "position": "position plan",
        "velocity": "velocity plan",
        "acceleration": "acceleration plan",
        "forces": "force plan",
        "balance": "diagram of the balance",
        "reactions": "diagram of reactions",
        "hodograph": "polar diagrams",
        "trajectory": "trajectory",
        "structure": "structural schemes",
        "meshing": "wheels in mesh",
        "flywheel": "diagrams of the flywheel",
        "diagram": "diagram",
        "stamp": "title block",
        "": "sheet",
    },
    pens={
        "main": "main",
        "thin": "thin",
        "frame": "frame",
        "axis": "axis",
        "hidden": "hidden",
        "thick axis": "thick axis",
        "phantom": "phantom",
        "hatch": "hatch",
        "break": "break",
        "pale": "pale",
    },
    lines={
        "hidden": "a dashed line",
        "axis": "a dash-dot line",
        "thick axis": "a thick dash-dot line",
        "phantom": "a dash-dot line with two dots",
    },
    things={
        "stroke": "a {pen} stroke",
        "arc": "a {pen} arc",
        "fill": "a fill",
        "disc": "a disc",
    },
    sheet="sheet {number} of {count}, {paper}",
    clean="no findings",
    counts="errors {errors}, warnings {warnings}",
    position=", position {number}",
    numbers="; {value} {unit}, limit {limit} {unit}",
    action="Next: {action}",
)
