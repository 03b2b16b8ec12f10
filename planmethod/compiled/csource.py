"""A tape as a function of C: one loop over positions that a compiler makes several at a time.

Nothing of a problem file comes into the source, not even its numbers: constants and limits are
parameters, so that all variants of a mechanism are one library.
"""

# no messages: source of a program

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import NamedTuple

from planmethod.compiled.pysource import BINARY, EQUAL, used_by
from planmethod.compiled.symbolic import Guard
from planmethod.compiled.tape import Ref, Tape

BLOCK = 512
"""Positions between two checks of the margins."""

BUFFER_PADDING = 24
"""Doubles between buffers: places a page apart push each other out of the cache."""

OPERATIONS_PER_LOOP = 200
"""Operations of one loop: longer ones are slower."""

ROWS_PER_LOOP = 20
"""Rows that one loop writes: more streams than that go slower through the memory."""

OPERATION_WEIGHTS = {"cosd": 30, "sind": 0, "atan2": 30}
"""Operations that one of these comes to; a sine comes with its cosine."""

GUARDS_PER_WORD = 63
"""Guards in one word of the margins that do not hold."""

FEW = 64
"""Positions below which a table of angles does not pay."""

_HEAD = (
    f"""#define BLOCK {BLOCK}
#define FEW {FEW}
#define EQUAL {EQUAL}
"""
    + """#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define INDEPENDENT _Pragma("GCC ivdep")
#endif
static inline double least(double a, double b) { return a < b || a != a ? a : b; }
static inline double most(double a, double b) { return a > b || a != a ? a : b; }
/* Cosine and sine of degrees: the rest of a quarter turn, exact, by the polynomials of fdlibm. */
static inline void turn(double degrees, double *cosine, double *sine)
{
    const double quarter = rint(degrees * (1.0 / 90.0));
    const double r = (degrees - quarter * 90.0) * (M_PI / 180.0), z = r * r, half = 0.5 * z;
    const double s = r + r * z * (-1.66666666666666324348e-01 + z * (8.33333333332248946124e-03
        + z * (-1.98412698298579493134e-04 + z * (2.75573137070700676789e-06
        + z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
    const double p = z * z * (4.16666666666666019037e-02 + z * (-1.38888888888741095749e-03
        + z * (2.48015872894767294178e-05 + z * (-2.75573143513906633035e-07
        + z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
    const double w = 1.0 - half, c = w + (((1.0 - w) - half) + p);
    const double turns = quarter - 4.0 * floor(quarter * 0.25);
    const double along = fabs(turns - 2.0) - 1.0, across = 1.0 - fabs(turns - 1.0);
    *cosine = c * along - s * across;
    *sine = s * along + c * across;
}
/* The same of n degrees x of a row of so many: by a table where the steps of the row are equal. */
static void turned(const double *x, long n, const double *row, long many, double *table,
                   double *cosine, double *sine)
{
    const long last = (many < BLOCK ? many : BLOCK) - 1;
    const double step = (row[last] - row[0]) / (double)(last + !last);
    double *c = table + 1, *s = c + BLOCK, along, across;
    uint64_t uneven = last < FEW;
    for (int i = 0; i < (int)n; i++)
        uneven |= fabs((x[i] - x[0]) - (double)i * step) < EQUAL ? 0 : UINT64_C(1);
    if (uneven) {
        INDEPENDENT
        for (int i = 0; i < (int)n; i++) turn(x[i], cosine + i, sine + i);
        return;
    }
    if (table[0] != step) {
        INDEPENDENT
        for (int i = 0; i < BLOCK; i++) turn((double)i * step, c + i, s + i);
        table[0] = step;
    }
    turn(x[0], &along, &across);
    INDEPENDENT
    for (int i = 0; i < (int)n; i++) { /* what rounding makes of the steps is corrected */
        const double rest = ((x[i] - x[0]) - (double)i * step) * (M_PI / 180.0);
        const double u = c[i] * along - s[i] * across, v = c[i] * across + s[i] * along;
        cosine[i] = u - v * rest;
        sine[i] = v + u * rest;
    }
}
static inline double angle(double y, double x)
{
    const double a = fabs(x), b = fabs(y), small = a < b ? a : b, large = a < b ? b : a;
    const int far = small > 0.41421356237309503 * large; /* above the tangent of 22.5 degrees */
    const double over = far ? large + small : large;
    const double t = (far ? small - large : small) / (over == 0.0 ? 1.0 : over), z = t * t;
    const double p = z * (3.33333333333329318027e-01 + z * (-1.99999999998764832476e-01
        + z * (1.42857142725034663711e-01 + z * (-1.11111104054623557880e-01
        + z * (9.09088713343650656196e-02 + z * (-7.69187620504482999495e-02
        + z * (6.66107313738753120669e-02 + z * (-5.83357013379057348645e-02
        + z * (4.97687799461593236017e-02 + z * (-3.65315727442169155270e-02
        + z * 1.62858201153657823623e-02))))))))));
    const double u = (far ? M_PI_4 : 0.0) + (t - t * p);
    const double v = a < b ? M_PI_2 - u : u;
    return copysign(x < 0.0 ? M_PI - v : v, y);
}
static inline double degrees(double radians)
{
    const double d = radians * (180.0 / M_PI);
    return d <= -180.0 ? 180.0 : d;
}
"""
)


class Source(NamedTuple):
    """C source of a tape, and its constants and inputs.

    Attributes
    ----------
    text : str
        Source of ``run(frame)``.
    constants : tuple of float
    inputs : tuple of int
        Inputs of the tape that it reads, in order.
    """

    text: str
    constants: tuple[float, ...]
    inputs: tuple[int, ...]


def c_source(
    tape: Tape,
    results: Sequence[Ref],
    guards: Sequence[Guard],
    depends: Sequence[frozenset[int]],
) -> Source:
    """Print a tape as the source of a function.

    Its only argument is a frame of 64-bit integers: variants, positions; address of the results,
    doubles from row to row of them and from variant to variant; address of the first guards that
    do not hold (int16, or 0), and from variant to variant; address of the constants; and for every
    input its address and doubles from variant to variant and from position to position (0 or 1).

    Parameters
    ----------
    results, guards, depends
        As of `Blocks`.
    """
    words = -(-len(guards) // GUARDS_PER_WORD)
    lines = _Lines(tape, results, guards)
    needs = [
        [
            _bits(sum(1 << g % GUARDS_PER_WORD for g in one if g // GUARDS_PER_WORD == word))
            for word in range(words)
        ]
        for one in depends
    ]
    return Source(_wrap_function(lines, needs, words), tuple(lines.constants), tuple(lines.inputs))


class _Lines:
    """Lines of the loops while they are written."""

    def __init__(self, tape: Tape, results: Sequence[Ref], guards: Sequence[Guard]) -> None:
        self.tape = tape
        self.loops: list[list[str]] = []
        self.constants: dict[float, str] = {}
        self.inputs: list[int] = []
        self.turned: set[int] = set()  # inputs of which a cosine or a sine is taken
        self.buffers = 0
        self.watched: set[int] = set()  # words of the margins that earlier loops have checked
        self._home: dict[int, str] = {}  # where the next loops find a node
        needed = used_by(tape, [*results, *(guard.margin for guard in guards)])
        if (
            len(needed) <= OPERATIONS_PER_LOOP
        ):  # all of it fits in the nearest cache: quickest as written
            needed.sort()
        stages = _stages(tape, needed, results)
        last = {ref: k for k, stage in enumerate(stages) for n in stage for ref in _used(tape, n)}
        rows = _places(results)
        watching = _places([guard.margin for guard in guards])
        ending: list[list[str]] = [[] for _ in stages]  # buffers by the stage that reads them last
        free: list[str] = []
        for k, stage in enumerate(stages):
            self._begin_loop(stage)
            for number in stage:
                self._write(number)
                for row in rows.get(number, ()):
                    self._text.append(f"o{row}[i] = {self._name(number)};")
                    self._home.setdefault(number, f"o{row}")
                for place in watching.get(number, ()):
                    self._watch(number, place, guards[place].limit)
                if last.get(number, k) > k and number not in self._home:
                    if not free:
                        free.append(f"b{self.buffers}")
                        self.buffers += 1
                    self._home[number] = free.pop()
                    ending[last[number]].append(self._home[number])
                    self._text.append(f"{self._home[number]}[i] = {self._name(number)};")
            self._end_loop()
            free += ending[k]
        for row, ref in enumerate(results):
            if type(ref) is float:
                self._text.append(f"o{row}[i] = {self._name(ref)};")

    def _begin_loop(self, stage: Sequence[int]) -> None:
        """Begin a loop with no values computed yet."""
        nodes = [self.tape.nodes[number] for number in stage]
        self._divisors = Counter(node.operands[1] for node in nodes if node.kind == "div")
        self._said: dict[int, str] = {}
        self._turned: dict[str, int] = {}
        self._inverse: dict[str, str] = {}
        self._text: list[str] = []
        self._here: list[int] = []  # words of the margins that this loop checks
        self.loops.append(self._text)

    def _end_loop(self) -> None:
        """End a loop: keep the margins that do not hold."""
        for word in self._here:
            self._text.append(f"bad{word}[i] = g{word}; any{word} |= g{word};")
        self.watched.update(self._here)

    def _name(self, ref: Ref) -> str:
        """Return the name of an operand; a constant becomes a parameter."""
        if type(ref) is not int:
            return self.constants.setdefault(float(ref), f"k{len(self.constants)}")
        if ref not in self._said:
            self._text.append(f"const double t{ref} = {self._home[ref]}[i];")
            self._said[ref] = f"t{ref}"
        return self._said[ref]

    def _write(self, number: int) -> None:
        """Write an operation."""
        kind, refs = self.tape.nodes[number]
        if kind == "input":
            self._home[number] = f"x{len(self.inputs)}"
            self.inputs.append(int(refs[0]))
            return
        if kind in ("cosd", "sind") and _is_input(self.tape, refs[0]):
            k = self.inputs.index(int(self.tape.nodes[int(refs[0])].operands[0]))
            self.turned.add(k)
            self._home[number] = f"{kind[0]}{k}"
            self._said[number] = f"{kind[0]}{k}[i]"
            return
        names = [self._name(ref) for ref in refs]
        self._said[number] = f"t{number}"
        if kind in ("cosd", "sind"):
            if names[0] not in self._turned:
                at = self._turned[names[0]] = len(self._turned)
                self._text.append(f"double u{at}, v{at}; turn({names[0]}, &u{at}, &v{at});")
            self._said[number] = f"{'uv'[kind == 'sind']}{self._turned[names[0]]}"
            return
        phrase = _expression(kind, names)
        # One division for all by the same divisor; constants are divided by before the loop.
        if kind == "div" and (type(refs[1]) is float or self._divisors[refs[1]] > 1):
            if names[1] not in self._inverse:
                self._inverse[names[1]] = f"r{len(self._inverse)}"
                self._text.append(f"const double {self._inverse[names[1]]} = 1.0 / {names[1]};")
            phrase = f"{names[0]} * {self._inverse[names[1]]}"
        self._text.append(f"const double t{number} = {phrase};")

    def _watch(self, number: int, place: int, limit: float) -> None:
        """Note where the margin of a guard does not hold."""
        word, bit = divmod(place, GUARDS_PER_WORD)
        holds = f"{self._name(number)} > {self._name(float(limit))}"
        if word not in self._here:
            self._here.append(word)
            before = f"bad{word}[i]" if word in self.watched else "0"
            self._text.append(f"uint64_t g{word} = {before};")
        self._text.append(f"g{word} |= {holds} ? 0 : {_bits(1 << bit)};")


def _places(refs: Sequence[Ref]) -> dict[int, list[int]]:
    """Return the index of every node in a sequence."""
    found: dict[int, list[int]] = {}
    for place, ref in enumerate(refs):
        if type(ref) is int:
            found.setdefault(ref, []).append(place)
    return found


def _is_input(tape: Tape, ref: Ref) -> bool:
    return type(ref) is int and tape.nodes[ref].kind == "input"


def _used(tape: Tape, number: int) -> list[int]:
    kind, refs = tape.nodes[number]
    return [] if kind == "input" else [ref for ref in refs if type(ref) is int]


def _stages(tape: Tape, needed: Sequence[int], results: Sequence[Ref]) -> list[list[int]]:
    """Cut operations into loops."""
    rows = Counter(ref for ref in results if type(ref) is int)
    stages: list[list[int]] = [[]]
    weight = written = 0
    for number in needed:
        kind, refs = tape.nodes[number]
        own = 0 if kind == "cosd" and _is_input(tape, refs[0]) else OPERATION_WEIGHTS.get(kind, 1)
        if weight + own > OPERATIONS_PER_LOOP or written + rows[number] > ROWS_PER_LOOP:
            stages.append([])
            weight = written = 0
        stages[-1].append(number)
        weight += own
        written += rows[number]
    return stages


def _bits(number: int) -> str:
    return f"UINT64_C({number:#x})"


def _wrap_function(lines: _Lines, needs: Sequence[Sequence[str]], words: int) -> str:
    """Wrap the loop in a function, followed by the handling of margins that do not hold."""
    rows = range(len(needs))
    own = [f"const double k{k} = k[{k}];" for k in range(len(lines.constants))]
    own += [f"double e{k}[{BLOCK}];" for k in range(len(lines.inputs))]
    own += [f"double b{k}[{BLOCK + BUFFER_PADDING}];" for k in range(lines.buffers)]
    own += [f"uint64_t bad{w}[{BLOCK}];" for w in range(words)]
    turned = sorted(lines.turned)
    own += [f"double c{k}[BLOCK], s{k}[BLOCK], table{k}[2 * BLOCK + 1] = {{NAN}};" for k in turned]
    here = [f"double *o{row} = out + {row} * f[3];" for row in rows]
    here += [f"uint64_t any{w} = 0;" for w in range(words)]
    here += [f"memset(bad{w}, 0, sizeof bad{w});" for w in range(words) if w not in lines.watched]
    for k in range(len(lines.inputs)):
        address, variant, position = (f"f[{8 + 3 * k + j}]" for j in range(3))
        here += [
            f"const double *x{k} = (const double *){address} + v * {variant}, *y{k} = x{k};",
            f"(void)y{k}; if ({position}) x{k} += first;",
            f"else {{ for (long i = 0; i < n; i++) e{k}[i] = *x{k}; x{k} = e{k}; }}",
        ]
        if k in lines.turned:
            row = f"{position} ? y{k} : x{k}, {position} ? f[1] : n"
            here.append(f"turned(x{k}, n, {row}, table{k}, c{k}, s{k});")
    look = []
    if words:
        table = ", ".join(f"{{{', '.join(one)}}}" for one in needs)
        hit = " | ".join(f"(any{w} & need[{w}])" for w in range(words))
        here_too = " | ".join(f"(bad{w}[i] & need[{w}])" for w in range(words))
        look = [
            f"if ({' | '.join(f'any{w}' for w in range(words))}) {{",
            f"    static const uint64_t needs[{len(needs)}][{words}] = {{{table}}};",
            f"    for (long row = 0; row < {len(needs)}; row++) {{",
            "        const uint64_t *need = needs[row];",
            "        double *o = out + row * f[3];",
            f"        if ({hit}) for (long i = 0; i < n; i++) o[i] = {here_too} ? NAN : o[i];",
            "    }",
            "    if (failed) for (long i = 0; i < n; i++) {",
        ]
        for w in reversed(range(words)):  # the first guard last: it stays
            first = f"failed[i] = (int16_t)({GUARDS_PER_WORD * w} + __builtin_ctzll(bad{w}[i]));"
            look.append(f"        if (bad{w}[i]) {first}")
        look += ["    }", "}"]
    loops = [
        "INDEPENDENT\n        for (long i = 0; i < n; i++) {\n            "
        + _joined(loop, 12)
        + "\n        }"
        for loop in lines.loops
    ]
    return f"""{_HEAD}void run(const int64_t *f)
{{
    const double *k = (const double *)f[7];
    (void)k;
    {_joined(own, 4)}
    for (long v = 0; v < f[0]; v++) for (long first = 0; first < f[1]; first += {BLOCK}) {{
        const long n = f[1] - first < {BLOCK} ? f[1] - first : {BLOCK};
        double *out = (double *)f[2] + v * f[4] + first;
        int16_t *failed = f[5] ? (int16_t *)f[5] + v * f[6] + first : 0;
        (void)out;
        {_joined(here, 8)}
        {_joined(loops, 8)}
        if (failed) for (long i = 0; i < n; i++) failed[i] = -1;
        {_joined(look, 8)}
    }}
}}
"""


def _joined(lines: Sequence[str], indent: int) -> str:
    return ("\n" + " " * indent).join(lines)


def _expression(kind: str, refs: list[str]) -> str:
    if kind in BINARY:
        return f"{refs[0]} {BINARY[kind]} {refs[1]}"
    match kind:
        case "neg":
            return f"-{refs[0]}"
        case "at_zero":
            return f"{refs[0]} == 0.0 ? {refs[1]} : {refs[2]}"
        case _:
            names = {"abs": "fabs", "min": "least", "max": "most", "atan2": "angle"}
            return f"{names.get(kind, kind)}({', '.join(refs)})"
