#include "film/laminar.h"

#include <math.h>

double sp_film_thickness(const sp_fluid *liquid, double per_width, double acceleration)
{
    return cbrt(3 * liquid->viscosity / liquid->density * per_width / acceleration);
}

double sp_film_jet_radius(const sp_fluid *liquid, double flow)
{
    double mass = liquid->density * flow;
    return 0.276 * pow(mass * mass * mass / (liquid->viscosity * liquid->density * liquid->surface_tension), 0.25);
}

double sp_film_wave(const sp_fluid *liquid, double gravity)
{
    return 2 * M_PI * sqrt(2 * liquid->surface_tension / (liquid->density * gravity));
}
