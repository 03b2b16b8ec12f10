/* One four-bar by the vector loop, for the speed benchmark.
 *
 *   A = (0, 0), D = (0.4, 0), AB = 0.1, BC = 0.35, CD = 0.3 (m),
 *   C to the left of the directed line B -> D, the crank turning at a constant omega.
 *
 * out holds 20 contiguous rows of n doubles, out[k * n + i]:
 *
 *    0.. 5  B.x B.y B.vx B.vy B.ax B.ay
 *    6..11  C.x C.y C.vx C.vy C.ax C.ay
 *   12..15  direction of link 2 (B -> C; cos, sin), omega_2, epsilon_2
 *   16..19  direction of link 3 (D -> C; cos, sin), omega_3, epsilon_3
 *
 * Compile with -O3 -march=native -fno-math-errno -fno-trapping-math. The first lets sqrt be an
 * instruction, the second lets the loop be done several positions at a time; neither changes a
 * result. There is no -ffast-math: nothing is reordered (a product and a sum may become one
 * rounding, as the compiler does by default).
 *
 * The crank is the shortest link and 0.1 + 0.4 < 0.35 + 0.3: it turns fully, BD stays within
 * 0.3 .. 0.5, and no position is dead. So no root is of a negative number, no divisor is zero,
 * and nothing is checked.
 */
#include <math.h>

#define FRAME 0.4
#define CRANK 0.1
#define COUPLER 0.35
#define ROCKER 0.3
#define RADIANS (3.14159265358979323846 / 180.0)
#define LONGEST_BLOCK 1024

#if defined(__clang__)
#define INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#elif defined(__GNUC__)
#define INDEPENDENT _Pragma("GCC ivdep") /* rows of out do not overlap */
#else
#define INDEPENDENT
#endif

/* Solve one position, given the direction (c, s) of the crank; out is at its column. */
static inline void position(double c, double s, long n, double omega, double *restrict out)
{
    const double bx = CRANK * c, by = CRANK * s;
    const double bvx = -omega * by, bvy = omega * bx;
    const double bax = -omega * bvy, bay = omega * bvx;

    /* C is at u along BD and v across it, in units of BD; the half chord is a product of
     * differences, not the difference of two squares. */
    const double dx = FRAME - bx, dy = -by;
    const double dd = dx * dx + dy * dy;
    const double reach = (COUPLER + ROCKER) * (COUPLER + ROCKER) - dd;
    const double fold = dd - (COUPLER - ROCKER) * (COUPLER - ROCKER);
    const double chord = sqrt(reach * fold); /* 4 areas of BCD */
    const double half = 0.5 / dd;
    const double u = (dd + (COUPLER - ROCKER) * (COUPLER + ROCKER)) * half;
    const double w = (dd - (COUPLER - ROCKER) * (COUPLER + ROCKER)) * half; /* 1 - u */
    const double v = chord * half;
    const double px = u * dx - v * dy, py = u * dy + v * dx;   /* B -> C */
    const double qx = -w * dx - v * dy, qy = v * dx - w * dy;  /* D -> C */

    /* p x q is twice the area of BCD; dot products with q and p tell the two unknowns apart. */
    const double inverse = -2.0 / chord;
    const double w2 = (bvx * qx + bvy * qy) * inverse;
    const double w3 = (bvx * px + bvy * py) * inverse;
    const double w22 = w2 * w2, w33 = w3 * w3;
    const double gx = bax - w22 * px + w33 * qx, gy = bay - w22 * py + w33 * qy;
    const double e2 = (gx * qx + gy * qy) * inverse;
    const double e3 = (gx * px + gy * py) * inverse;

    out[0 * n] = bx;
    out[1 * n] = by;
    out[2 * n] = bvx;
    out[3 * n] = bvy;
    out[4 * n] = bax;
    out[5 * n] = bay;
    out[6 * n] = FRAME + qx;
    out[7 * n] = qy;
    out[8 * n] = -w3 * qy;
    out[9 * n] = w3 * qx;
    out[10 * n] = -e3 * qy - w33 * qx;
    out[11 * n] = e3 * qx - w33 * qy;
    out[12 * n] = px * (1.0 / COUPLER);
    out[13 * n] = py * (1.0 / COUPLER);
    out[14 * n] = w2;
    out[15 * n] = e2;
    out[16 * n] = qx * (1.0 / ROCKER);
    out[17 * n] = qy * (1.0 / ROCKER);
    out[18 * n] = w3;
    out[19 * n] = e3;
}

/* Solve at any n angles: a sine and a cosine of the C library each. */
void fourbar_libm(const double *restrict phi_deg, long n, double omega, double *restrict out)
{
    for (long i = 0; i < n; i++) {
        const double phi = phi_deg[i] * RADIANS;
        position(cos(phi), sin(phi), n, omega, out + i);
    }
}

/* Solve at n angles equally spaced: a table of about sqrt(n) angles and their addition. */
void fourbar_table(double from_deg, double step_deg, long n, double omega, double *restrict out)
{
    double tc[LONGEST_BLOCK], ts[LONGEST_BLOCK];
    long block = 8;
    while (block < LONGEST_BLOCK && block * block < n)
        block *= 2;
    if (block > n)
        block = n;
    for (long i = 0; i < block; i++) {
        const double phi = (double)i * step_deg * RADIANS;
        tc[i] = cos(phi);
        ts[i] = sin(phi);
    }
    for (long first = 0; first < n; first += block) {
        const double phi = (from_deg + (double)first * step_deg) * RADIANS;
        const double c0 = cos(phi), s0 = sin(phi);
        const long count = n - first < block ? n - first : block;
        double *restrict at = out + first;
        INDEPENDENT
        for (long i = 0; i < count; i++)
            position(c0 * tc[i] - s0 * ts[i], s0 * tc[i] + c0 * ts[i], n, omega, at + i);
    }
}
