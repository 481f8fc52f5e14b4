/* The blocks of keys, by what they describe, and how their tables are written. */
#ifndef KEYS_BLOCKS_H
#define KEYS_BLOCKS_H

#include <sprayplan/keys.h>

#include <math.h>
#include <stddef.h>

extern const sp_dimension sp_length_unit, sp_angle_unit, sp_ratio_unit, sp_share_unit, sp_pressure_unit, sp_flow_unit,
    sp_flux_unit, sp_width_flow_unit, sp_dose_unit, sp_speed_unit, sp_density_unit, sp_viscosity_unit, sp_tension_unit,
    sp_acceleration_unit, sp_turning_unit, sp_teeth_unit;

enum { SP_MAX_ITEMS = 10000 }; /* of nozzles, types, mounts, geometry files */
#define SP_MAX_JETS 1e12

/* scene.c */
extern const sp_block sp_block_scene, sp_block_geometry, sp_block_rotate, sp_block_sweep, sp_block_cap, sp_block_liquid,
    sp_block_air, sp_block_criterion, sp_block_datum, sp_block_nozzle, sp_block_simulate, sp_block_report;
/* place.c */
extern const sp_block sp_block_place, sp_block_refine, sp_block_mount, sp_block_port, sp_block_depth,
    sp_block_lance_step, sp_block_surface, sp_block_line, sp_block_box, sp_block_alternative, sp_block_limited_mount;
/* catalogue.c */
extern const sp_block sp_block_catalogue, sp_block_type, sp_block_type_step, sp_block_member, sp_block_ring,
    sp_block_rotation, sp_block_jet;
/* result.c */
extern const sp_block sp_block_result;
/* files.c */
extern const sp_block sp_block_files;
/* check.c, study.c, bench.c */
extern const sp_block sp_block_check, sp_block_study, sp_block_atlas, sp_block_bench;
/* outputs.c */
extern const sp_block sp_block_outputs;

/* keys.c: the key of that name, which the block has. */
const sp_key *sp_key_of(const sp_block *block, const char *name);

/* form.c: "a pressure above 0 such as 2 bar", of a key with a dimension; and "z or y", of one with words. */
void sp_quantity_form(const sp_key *key, char form[SP_KEY_FORM]);
void sp_words_form(const char *const *words, char form[SP_KEY_FORM]);

/* Ranges. */
#define SP_ANY                                                                                                         \
    {                                                                                                                  \
        -INFINITY, INFINITY, false, false                                                                              \
    }
#define SP_FROM(least)                                                                                                 \
    {                                                                                                                  \
        least, INFINITY, false, false                                                                                  \
    }
#define SP_ABOVE(least)                                                                                                \
    {                                                                                                                  \
        least, INFINITY, true, false                                                                                   \
    }
#define SP_BETWEEN(least, most)                                                                                        \
    {                                                                                                                  \
        least, most, false, false                                                                                      \
    }
#define SP_ABOVE_TO(least, most)                                                                                       \
    {                                                                                                                  \
        least, most, true, false                                                                                       \
    }
#define SP_FROM_BELOW(least, most)                                                                                     \
    {                                                                                                                  \
        least, most, false, true                                                                                       \
    }

#endif
