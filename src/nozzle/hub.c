/* Two axes. What of a jet lies at the height u over the hub's middle plane, per u, is (2/Ω) β, with cos β = cos
 * a / √(1 - u²), for a cone of half angle a and solid angle Ω. It goes round the hub's axis, evenly, on a
 * small circle of polar angle acos(u), so that its angle ϑ from the body's axis follows cos ϑ = √(1 - u²) cos
 * τ. In the mean, then, the share acos(cos ϑ / √(1 - u²)) / π of it leaves within ϑ, and 1 / (2π²
 * √(sin²ϑ - u²)) per steradian at ϑ: for a thin jet, 1 / (2π² sin ϑ). Over the jet both are integrals
 * without closed form; in ξ, u = m sin ξ, with m the lesser of sin a and sin ϑ, they are smooth. */
#include "caps.h"
#include "turned.h"

#include <assert.h>

/* Gauss and Legendre's abscissae and weights, 16 points on [-1, 1]. */
static const double gauss[8][2] = {
    {0.98940093499164994, 0.027152459411754095}, {0.9445750230732326, 0.062253523938647893},
    {0.86563120238783176, 0.095158511682492785}, {0.755404408355003, 0.12462897125553387},
    {0.61787624440264377, 0.14959598881657673},  {0.45801677765722737, 0.16915651939500254},
    {0.28160355077925892, 0.1826034150449236},   {0.095012509837637441, 0.1894506104550685},
};

/* The integral over a full cone, of the share within the polar angle (up to π/2) or of the density there. */
static double integrate(double outer, double polar, bool density)
{
    assert(outer > 0 && outer < M_PI / 2 && polar >= 0 && polar <= M_PI / 2);
    double edge = sin(outer), sine = sin(polar), most = fmin(edge, sine), sum = 0;
    for (int i = 0; i < 16; i++) {
        double x = i < 8 ? gauss[i][0] : -gauss[i - 8][0], turn = 0.25 * M_PI * (1 + x);
        double u = most * sin(turn), weight = 0.25 * M_PI * gauss[i % 8][1] * most * cos(turn);
        double half_chord = atan2(sqrt(fmax(0, (edge - u) * (edge + u))), cos(outer));
        double left = sqrt(fmax(0, (sine - u) * (sine + u)));
        /* both sides of the plane */
        sum += 2 * weight * half_chord * (density ? 1 / left : 2 * M_PI * atan2(left, cos(polar)));
    }
    return sum / (2 * M_PI * M_PI * M_PI * sp_cap_height(0, outer));
}

double sp_hub_within(double outer, double polar)
{
    return polar > M_PI / 2 ? 1 - integrate(outer, M_PI - polar, false) : integrate(outer, polar, false);
}

double sp_hub_density(double outer, double polar)
{
    /* on the axis the ring is a point, about which the density is even */
    return integrate(outer, fmax(fmin(polar, M_PI - polar), 1e-9 * outer), true);
}
