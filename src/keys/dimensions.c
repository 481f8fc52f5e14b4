/* What quantities in scenes and catalogues measure. */
#include "keys/blocks.h"

const sp_dimension sp_length_unit = {"a length", "m", "250 mm", true};
const sp_dimension sp_angle_unit = {"an angle", "rad", "30 deg", false};
const sp_dimension sp_ratio_unit = {"a number without unit", "1", "0.5", true};
const sp_dimension sp_share_unit = {"a share", "1", "95 %", true};
const sp_dimension sp_pressure_unit = {"a pressure", "Pa", "2 bar", false};
const sp_dimension sp_flow_unit = {"a flow", "m3/s", "12 L/min", false};
const sp_dimension sp_width_flow_unit = {"a flow per width", "m2/s", "10 L/min/m", false};
const sp_dimension sp_dose_unit = {"a dose", "m3/m2", "2 L/m2", false};
const sp_dimension sp_flux_unit = {"a flux", "m3/s/m2", "1 L/min/m2", false};
const sp_dimension sp_speed_unit = {"a speed", "m/s", "1 m/s", false};
const sp_dimension sp_density_unit = {"a density", "kg/m3", "1000 kg/m3", false};
const sp_dimension sp_viscosity_unit = {"a viscosity", "Pa.s", "1 mPa.s", false};
const sp_dimension sp_tension_unit = {"a surface tension", "N/m", "72 mN/m", false};
const sp_dimension sp_acceleration_unit = {"an acceleration", "m/s2", "9.81 m/s2", false};
const sp_dimension sp_turning_unit = {"a speed of rotation", "rad/s", "3 rpm", false};
const sp_dimension sp_teeth_unit = {"a number of teeth", "1", "43", true};
