"""Mistakes of students in English (ошибки студентов по-английски)."""

from planmethod.note.wording.check_model import MistakeWords as Words

MISTAKES = {
    "V1": Words(
        "relative velocity drawn along the link",
        "the relative velocity is drawn along the link",
        "Points of a link can only move across it relative to each other: draw this ray "
        "perpendicular to the link.",
    ),
    "V2": Words(
        "crank turned the other way",
        "the crank turns the other way",
        "Turn the velocity of the crank pin by 180° to the sense of the task: lengths stay as "
        "they are, directions change.",
    ),
    "V3": Words(
        "similarity with a wrong ratio or mirrored",
        "the ratio of similarity is inverted or the figure is mirrored",
        "The figure on the plan is similar to the link, its letters run the same way round: for a "
        "point S of link AB, as : ab equals AS : AB.",
    ),
    "V4": Words(
        "relative velocity in the sliding pair left out",
        "the slider does not slide on its guide",
        "The point of the guide under the slider differs from the slider by the velocity of "
        "sliding along the guide: draw the triangle of velocities.",
    ),
    "V5": Words(
        "angular velocity found with another arm",
        "the velocity is divided by another arm",
        "Divide the velocity by the distance from the axis in this position: measure it on the "
        "drawing of the mechanism and multiply by μ_l.",
    ),
    "V6": Words(
        "relative velocity taken for the absolute one",
        "the segment of a relative velocity is measured instead of that from the pole",
        "An absolute velocity is measured from the pole p, a relative one between the heads of "
        "the vectors.",
    ),
    "A1": Words(
        "Coriolis acceleration left out",
        "the Coriolis acceleration is left out",
        "The guide turns, so lay off a^{k} = 2ω·v_{r} as well: v_{r} turned by 90° in the sense "
        "in which the guide turns.",
    ),
    "A2": Words(
        "Coriolis acceleration reversed",
        "the Coriolis acceleration is laid off the other way",
        "Turn the relative velocity by 90° in the sense of the guide's angular velocity: that is "
        "where the Coriolis acceleration points.",
    ),
    "A3": Words(
        "factor 2 of the Coriolis acceleration missing",
        "the Coriolis acceleration is taken as ω·v_{r}, without the 2",
        "The formula is a^{k} = 2ω·v_{r}: double this vector.",
    ),
    "A4": Words(
        "not the relative velocity in the Coriolis acceleration",
        "an absolute velocity is put into the Coriolis acceleration",
        "What goes into a^{k} = 2ω·v_{r} is the velocity of sliding along the guide.",
    ),
    "A5": Words(
        "angular velocity of the crank in the Coriolis acceleration",
        "the angular velocity of the crank is put into the Coriolis acceleration",
        "It needs the angular velocity of the guide: that is what turns.",
    ),
    "A6": Words(
        "superfluous Coriolis acceleration",
        "a Coriolis acceleration is added where the guide does not turn",
        "The guide does not turn, so there is no Coriolis acceleration: take this vector out.",
    ),
    "N1": Words(
        "normal acceleration pointing away from the centre",
        "the normal acceleration points away from the centre",
        "A normal acceleration always points to the centre of rotation: lay it off the other way.",
    ),
    "N2": Words(
        "normal acceleration left out",
        "the normal acceleration is left out",
        "While a link turns, its points have a normal acceleration ω²·l: lay it off before the "
        "tangential one.",
    ),
    "N3": Words(
        "normal acceleration by another formula or another link",
        "the normal acceleration is computed by another formula or for another link",
        "It is v²/l or ω²·l, with the velocity and the length of this very link.",
    ),
    "N4": Words(
        "tangential acceleration drawn along the link",
        "the tangential acceleration is drawn along the link",
        "The tangential acceleration is perpendicular to the link: draw its ray from the end of "
        "the normal one, at a right angle to it.",
    ),
    "N5": Words(
        "another segment of the plan measured",
        "another segment of the plan is measured",
        "The whole acceleration is measured from the pole π, the tangential one from the end of "
        "the normal one: compare the letters of the segment with the vector.",
    ),
    "E1": Words(
        "angular acceleration in the other sense",
        "the angular acceleration has the other sense",
        "Carry the tangential acceleration to its point of the link: the way it turns the link is "
        "the sense of ε.",
    ),
    "E2": Words(
        "angular acceleration from the whole acceleration",
        "the whole acceleration is divided by the arm, not the tangential one",
        "ε = a^{τ}/l: divide the tangential component only.",
    ),
    "S1": Words(
        "scale of the plan inverted",
        "the segment is divided by the scale",
        "The scale μ tells how many units a millimetre stands for: multiply the length by it.",
    ),
    "S2": Words(
        "units not converted",
        "units are not converted",
        "Convert all data to SI: mm to m, rpm to rad/s, degrees to radians.",
    ),
    "S3": Words(
        "scale of another plan",
        "the scale of another plan is used",
        "Each plan has its own scale: velocities take μ_{v}, accelerations μ_{a}, lengths μ_{l}.",
    ),
    "S4": Words(
        "decimal point moved or digits swapped",
        "the decimal point is moved or digits are swapped",
        "The drawing seems to be right: copy the number with care.",
    ),
    "F1": Words(
        "inertia force along the acceleration",
        "the inertia force points along the acceleration",
        "The inertia force Φ = −m·a_{S} points against the acceleration of the centre of mass: "
        "turn the vector round.",
    ),
    "F2": Words(
        "inertia couple left out or in the sense of ε",
        "the inertia couple is left out or has the sense of ε",
        "The inertia couple J_{S}·ε acts on the link against its angular acceleration.",
    ),
    "F3": Words(
        "mass taken for weight, or weight left out",
        "the mass is taken for the weight or the weight is left out",
        "The weight is G = m·g with g = 9.81 m/s².",
    ),
    "F4": Words(
        "arm of a force measured wrongly",
        "the arm is measured along the line or not multiplied by μ_{l}",
        "The arm is the perpendicular from the point to the line of action, multiplied by μ_{l}.",
    ),
    "F5": Words(
        "reaction reversed",
        "the reaction is reversed",
        "R_{12} and R_{21} are equal and opposite: look which link the force acts on.",
    ),
    "Z1": Words(
        "Zhukovsky's lever: velocity plan not turned",
        "the forces are applied to a velocity plan that is not turned",
        "Turn the velocity plan by 90°, or turn all forces by 90°, but only one of them.",
    ),
    "Z2": Words(
        "Zhukovsky's lever: moment not converted",
        "a moment is carried to the lever as it is",
        "Replace a moment by a pair of forces at the ends of its link, or multiply it by ab/l: on "
        "the plan the link has another length.",
    ),
    "P1": Words(
        "mechanism assembled the other way or in another position",
        "the group is assembled on the other side or the crank is in another position",
        "Compare the drawing with the task: angle of the crank, the way it is counted, and the "
        "side on which the group is assembled.",
    ),
    "P2": Words(
        "another variant solved",
        "the data of another variant are used",
        "Compare the number of the variant and its data, and talk to the instructor: the way of "
        "the solution may well be right.",
    ),
    "sign": Words(
        "sense of rotation reversed",
        "the sense of rotation is reversed",
        "The magnitude is right. Carry the vector of the relative velocity (for ε, of the "
        "tangential acceleration) to its point of the link and see which way it turns the link.",
    ),
    "slip": Words(
        "slip of arithmetic",
        "there is a slip in the calculation",
        "The segment is drawn well: compute the last operation again.",
    ),
    "true_mm": Words(
        "true length taken for the drawn one",
        "the true length of the link is taken instead of the segment on the drawing",
        "The segment on the drawing and the length of the link differ by μ_{l}: see which of them "
        "the formula wants.",
    ),
    "scale": Words(
        "computed with another scale than the one stated",
        "another scale is used than the one stated in the work",
        "Check the scale of this plan: it is the same for all its segments.",
    ),
    "G1": Words(
        "sign of a mesh wrong",
        "the sign is forgotten: wheels in external mesh turn in opposite senses, in internal mesh "
        "in the same one",
        "An external mesh gives its ratio a minus, an internal one a plus: multiply the signs of "
        "all stages anew.",
    ),
    "G2": Words(
        "ratio inverted",
        "the inverse ratio is taken",
        "U_{1-2} = n_{1}/n_{2} = z_{2}/z_{1}: the teeth of the driven wheel over those of the "
        "driving one.",
    ),
    "G3": Words(
        "carrier left out of account",
        "the ratio seen from the carrier is taken for the real one",
        "Hold the carrier in mind: (n_{1} − n_{H})/(n_{3} − n_{H}) = U^{(H)}_{13}; with wheel 3 "
        "fixed that makes U_{1H} = 1 − U^{(H)}_{13}.",
    ),
    "G4": Words(
        "teeth of another rim of the same shaft",
        "the rims of a double wheel are exchanged",
        "Only the two rims in mesh go into the ratio of a stage: see on the scheme which they are.",
    ),
    "K1": Words(
        "tangential and normal acceleration exchanged",
        "tangential and normal acceleration are exchanged",
        "The tangential acceleration is the projection on the velocity: a_{τ} = (v_{x}·a_{x} + "
        "v_{y}·a_{y})/v; the normal one is the rest.",
    ),
    "K2": Words(
        "whole acceleration taken for its part",
        "the whole acceleration is taken for its part",
        "The whole acceleration is the root of the squares of both parts: neither is larger.",
    ),
    "K3": Words(
        "root not taken",
        "the root of the sum of squares is forgotten",
        "The length of a vector is the root of the sum of the squares of its projections: take it.",
    ),
    "K4": Words(
        "projections added as numbers",
        "the projections are added without squares",
        "Projections add by Pythagoras: the root of the sum of their squares.",
    ),
    "K5": Words(
        "velocity not squared in the radius of curvature",
        "the velocity itself is divided by the normal acceleration",
        "ρ = v^{2}/a_{n}: square the velocity.",
    ),
    "K6": Words(
        "argument taken in degrees",
        "sine and cosine are taken of degrees in place of radians",
        "Arguments are radians: set the calculator to them and compute anew.",
    ),
}
