"""Words of the checking of works in English (проверка работ по-английски)."""

from planmethod.note.wording.check_model import (
    CheckWording,
    ComparedWording,
    KeyWording,
    ResultWording,
    StudentWording,
)
from planmethod.note.wording.en.mistakes import MISTAKES

CHECK = CheckWording(
    verdicts={
        "ok": "right",
        "near": "nearly right",
        "inherited": "follows from your numbers",
        "wrong": "wrong",
        "inconsistent": "right, but not from your numbers",
        "unseen": "not to be seen on the drawing",
        "blank": "no answer",
        "unreadable": "not readable",
    },
    senses={
        "ccw": ("↺", "counter-clockwise"),
        "cw": ("↻", "clockwise"),
        "up": ("↑", "up"),
        "down": ("↓", "down"),
        "left": ("←", "to the left"),
        "right": ("→", "to the right"),
    },
    mistakes=MISTAKES,
    key=KeyWording(
        title="Key",
        variant="Variant {variant}",
        position="position {position}",
        scales="Scales: {scales}.",
        columns=("Quantity", "Value ± tolerance", "Unit", "Segment", "mm", "Sense", "Points", ""),
        rows=("Variant", "Position"),
        unseen="not to be seen on the drawing",
        zero="zero: the segment is too short",
        note=(
            "The tolerance is the error of drawing this quantity carefully with a pencil; the "
            "rounding of the number written is added to it. Quantities marked “{unseen}” are only "
            "compared with the student's own numbers."
        ),
        computed=(
            "The tolerance of what is computed is a share of it, of what is read off a picture the "
            "error of drawing by pencil; the rounding of what is written is added."
        ),
        hidden="These answers do not show the mistakes:",
        sheet="Key",
        sheet_hidden="Not shown",
    ),
    results=ResultWording(
        sheets=("Summary", "Answers", "Mistakes of the group", "Settings"),
        summary=("Student", "Variant", "Points", "of", "%", "Mark", "Mistakes", "Remark"),
        answers=(
            "Student",
            "Variant",
            "Quantity",
            "Verdict",
            "Follows from",
            "Written",
            "Right",
            "± tolerance",
            "Unit",
            "mm",
            "Right, mm",
            "Sense",
            "Right sense",
            "From own numbers",
            "Points",
            "of",
            "Cell",
            "Remark",
        ),
        by_code=("Code", "Mistake", "Works", "Perhaps also", "Whose"),
        by_answer=("Quantity", "Answers", "Accepted", "Share of points"),
        settings=("Setting", "Value"),
        perhaps="perhaps",
        unknown="not recognised",
        suspicious="closer than any pencil comes: probably not read off the drawing",
        by_hand="set by hand",
        files="File",
    ),
    compared=ComparedWording(
        columns=("Quantity", "Yours", "Exact", "Difference", "%"),
        note="Compared with the exact values. What is read off a plan differs from them in a right "
        "work, too; `planmethod solve --sigma` tells by how much.",
    ),
    student=StudentWording(
        title="Check of your work",
        student="Student",
        variant="Variant",
        points="Points: {points} of {of}",
        mark="Mark: {mark}",
        counted="Answers accepted: {right} of {count}.",
        remarks="Remarks",
        all_right="All answers are right, and the drawing is careful.",
        answers="Answers",
        columns=("No.", "Quantity", "Yours", "Right", "mm: yours / right", "Verdict", "Points"),
        tolerance=(
            "What stands after ± is the error of drawing carefully with a pencil; within it an "
            "answer counts as right."
        ),
        computed="After ±: how far an answer may be off the exact one.",
        plans="Your segments on the true plan",
        plan_names={"velocity": "velocity plan", "acceleration": "acceleration plan"},
        plan_title="{plan}, {scale}",
        position="position {position}",
        legend=(
            "Grey is the true plan. Blue are your segments that are right; red and dashed, with "
            "the number of the answer, the others: the direction is that of the true plan, the "
            "length is yours."
        ),
        legend_mistake=(
            "Grey is the true plan, blue are your segments that are right. Red and dashed is the "
            "plan with the mistake “{name}”, which gives your numbers; with the number of the "
            "answer, your segments on it."
        ),
        redraw="What to draw anew",
        redraw_line="segment {segment} ({plan}): it should be {right}",
        compared="{answer}: you have {own}, right is {right}.",
        mistake="This comes out{value} if {so}{where}. {advice}",
        mistake_here={"link": " (link {where})", "pair": " (pair {where})", "": " ({where})"},
        also="The same shows in {answers}.",
        follow="{answers}: a consequence of the same mistake, no need to mend them one by one.",
        one_of="The numbers fit one of: {names}.",
        one_of_end="Check these places one after another, beginning with {answer}.",
        unknown="The numbers do not tell the cause: check how the segment {segment} is drawn.",
        unknown_computed=(
            "The numbers do not tell the cause: check the calculation and what goes into it."
        ),
        kept="no points lost for it",
        reduced="{points} of {of} points",
        inherited="{answers}: computed consistently from your value of {source}, {points}.",
        near="{answer}: you have {own}, right is {right}, a little beyond the error of "
        "drawing{points}. Check the construction.",
        near_points=", {points} of {of} points",
        inconsistent=(
            "{answer}: the number is right ({own}), but your earlier answers give {local}. Show "
            "how you found it."
        ),
        sense="{answer}: the magnitude is right, the sense is not: it is {right}.",
        unseen=(
            "The drawing does not show reliably (the error of drawing is larger than what is "
            "allowed): {answers}. They were not compared with the exact values, only with your "
            "own earlier numbers."
        ),
        no_sense="The sense is missing: {answers}. It costs a part of their points.",
        slip="{answer}: {mm} mm · {scale} = {product}, but {own} is written. Check the "
        "calculation.",
        slip_bare="{answer}: {own} is not the segment times the scale. Check the calculation.",
        blank="No answer: {answers}.",
        unreadable="{answer}: not readable{where}: {reason}. Show it to the instructor: the answer "
        "has not been judged yet.",
        unreadable_other="Not readable{where}: {reason}.",
        remark="Remark of the instructor: {remark}",
        page="{student} · page {page}",
        quoted="“{text}”",
        source="follows from your {source}",
        share="{points} of {of}",
    ),
)
