/* sprayplan: where to put spray nozzles. This header includes the whole public interface.
 *
 * SI units throughout (m, s, kg, rad, m³/s). Functions that can fail take an sp_error last and return NULL or false;
 * given NULL from an earlier failure they return NULL and keep its error. The library prints nothing and keeps no
 * global state. */
#ifndef SPRAYPLAN_H
#define SPRAYPLAN_H

#define SP_VERSION "0.1.0"

#include <sprayplan/atlas.h>
#include <sprayplan/cad.h>
#include <sprayplan/coverage.h>
#include <sprayplan/deviation.h>
#include <sprayplan/error.h>
#include <sprayplan/evaluator.h>
#include <sprayplan/fitting.h>
#include <sprayplan/flight.h>
#include <sprayplan/image.h>
#include <sprayplan/keys.h>
#include <sprayplan/launch.h>
#include <sprayplan/mesh.h>
#include <sprayplan/nozzle.h>
#include <sprayplan/place.h>
#include <sprayplan/points.h>
#include <sprayplan/ranks.h>
#include <sprayplan/report.h>
#include <sprayplan/result.h>
#include <sprayplan/run.h>
#include <sprayplan/scene.h>
#include <sprayplan/setup.h>
#include <sprayplan/study.h>
#include <sprayplan/trace.h>
#include <sprayplan/tracks.h>
#include <sprayplan/vector.h>

#endif
