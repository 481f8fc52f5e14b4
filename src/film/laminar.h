/* What single films are like, in closed form. */
#ifndef FILM_LAMINAR_H
#define FILM_LAMINAR_H

#include <sprayplan/nozzle.h>

/* Thickness (m) of a film of so much flow per width (m²/s) on a wall along which gravity pulls by `acceleration`
 * (m/s²): the laminar film of Nusselt, Zeitschrift des VDI 60, 1916. */
double sp_film_thickness(const sp_fluid *liquid, double per_width, double acceleration);
/* Radius (m) within which the liquid (m³/s) of a solid stream that hits a wall spreads all round before it runs down:
 * .276 (ṁ³/(μ ρ σ))^¼ (Wilson, Le, Dao, Lai, Morison and Davidson, Chemical Engineering Science 68, 2012; contact angle
 * 90°). */
double sp_film_jet_radius(const sp_fluid *liquid, double flow);

/* Length (m) of the wave that grows fastest on a film beneath a ceiling, 2π √2 √(σ/ρg) (Rayleigh and Taylor; Fermigier,
 * Limat, Wesfreid, Boudinet and Quilliet, Journal of Fluid Mechanics 236, 1992): 24 mm for water. `gravity` in m/s². */
double sp_film_wave(const sp_fluid *liquid, double gravity);

#endif
