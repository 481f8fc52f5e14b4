/* sprayplan trace: nearest hits of lines or parabolas from a file. */
#include "cli.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 1 << 16 };

typedef struct {
    const char *path;
    FILE *file;
    int line;
    char *text;
    size_t capacity;
} ray_reader;

static const char *skip_blanks(const char *text)
{
    return text + strspn(text, " \t");
}

static bool parse_ray(ray_reader *reader, sp_ray *ray, sp_error *error)
{
    double number[6];
    const char *at = reader->text;
    for (int i = 0; i < 6; i++) {
        char *end;
        at = skip_blanks(at);
        errno = 0;
        number[i] = strtod(at, &end);
        if (end == at || !isfinite(number[i]) || (errno == ERANGE && number[i] != 0 && fabs(number[i]) > 1))
            return sp_fail(error, SP_ERROR_INPUT, reader->path, reader->line, (int)(at - reader->text) + 1,
                           "found \"%.40s\", expected a number (ox,oy,oz,vx,vy,vz)", at);
        at = skip_blanks(end);
        if (i < 5 && *at++ != ',')
            return sp_fail(error, SP_ERROR_INPUT, reader->path, reader->line, (int)(at - reader->text),
                           "found %d of 6 numbers, expected a comma (ox,oy,oz,vx,vy,vz)", i + 1);
    }
    if (*at && *at != '#')
        return sp_fail(error, SP_ERROR_INPUT, reader->path, reader->line, (int)(at - reader->text) + 1,
                       "found \"%.40s\" after 6 numbers, expected the end of the line", at);
    *ray = (sp_ray){.origin = sp_v(number[0], number[1], number[2]),
                    .velocity = sp_v(number[3], number[4], number[5]),
                    .t_max = INFINITY,
                    .skip = SP_NONE};
    if (sp_length(ray->velocity) == 0)
        return sp_fail(error, SP_ERROR_INPUT, reader->path, reader->line, 1,
                       "found a velocity of 0, expected any other");
    return true;
}

/* Up to BATCH rays; fewer at the end of the file. */
static bool read_batch(ray_reader *reader, sp_ray *rays, size_t *count, sp_error *error)
{
    ssize_t length;
    *count = 0;
    while (*count < BATCH && (length = getline(&reader->text, &reader->capacity, reader->file)) >= 0) {
        reader->line++;
        if (memchr(reader->text, 0, (size_t)length))
            return sp_fail(error, SP_ERROR_INPUT, reader->path, reader->line, 1, "found a zero byte, expected text");
        reader->text[strcspn(reader->text, "\r\n")] = 0;
        const char *first = skip_blanks(reader->text);
        if (!*first || *first == '#')
            continue;
        if (!parse_ray(reader, &rays[*count], error))
            return false;
        ++*count;
    }
    if (ferror(reader->file))
        return sp_fail(error, SP_ERROR_INPUT, reader->path, 0, 0, "cannot be read");
    /* What ends before the file does is a line that found no room. */
    return *count == BATCH || feof(reader->file) || sp_fail_memory(error);
}

static void print_hit(const sp_tracer *tracer, size_t number, const sp_ray *ray, const sp_hit *hit, sp_vec3 gravity,
                      bool json)
{
    if (hit->triangle == SP_NONE) {
        if (json)
            printf("%snull", number ? ",\n" : "");
        else
            printf("%zu,,,,,,,,,\n", number);
        return;
    }
    const sp_mesh *mesh = sp_tracer_mesh(tracer);
    sp_vec3 point = sp_ray_point(ray, gravity, hit->t);
    sp_vec3 velocity = sp_ray_velocity(ray, gravity, hit->t);
    double speed = sp_length(velocity);
    double cosine = fabs(sp_dot(sp_unit(velocity), sp_triangle_normal(mesh, hit->triangle)));
    double incidence = acos(cosine > 1 ? 1 : cosine) * 180 / M_PI;
    const char *format = json ? "%s{\"ray\": %zu, \"t\": %.17g, \"triangle\": %lu, \"u\": %.17g, \"v\": %.17g, "
                                "\"x\": %.17g, \"y\": %.17g, \"z\": %.17g, \"speed\": %.17g, \"incidence_deg\": %.17g}"
                              : "%s%zu,%.17g,%lu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n";
    printf(format, json && number ? ",\n" : "", number, hit->t, (unsigned long)mesh->source[hit->triangle],
           hit->u + 0.0, hit->v + 0.0, point.x, point.y, point.z, speed, incidence);
}

static bool trace_file(ray_reader *reader, const sp_tracer *tracer, const cli_options *options, sp_error *error)
{
    sp_ray *rays = malloc(BATCH * sizeof *rays);
    sp_hit *hits = malloc(BATCH * sizeof *hits);
    size_t count = 0, total = 0;
    bool good = rays && hits;
    if (!good)
        sp_fail_memory(error);
    while (good && (good = read_batch(reader, rays, &count, error)) && count) {
        sp_trace_nearest_many(tracer, rays, count, options->gravity, options->threads, hits);
        if (total == 0)
            printf("%s", options->json ? "{\"sprayplan\": \"" SP_VERSION "\", \"command\": \"trace\", \"hits\": [\n"
                                       : "ray,t,triangle,u,v,x,y,z,speed,incidence_deg\n");
        for (size_t i = 0; i < count; i++)
            print_hit(tracer, total + i, &rays[i], &hits[i], options->gravity, options->json);
        total += count;
    }
    if (good && total == 0)
        printf("%s", options->json ? "{\"sprayplan\": \"" SP_VERSION "\", \"command\": \"trace\", \"hits\": ["
                                   : "ray,t,triangle,u,v,x,y,z,speed,incidence_deg\n");
    if (good && options->json)
        printf("]}\n");
    free(rays);
    free(hits);
    return good;
}

int cli_trace(const cli_options *options)
{
    sp_error error = {0};
    if (!options->rays) {
        fprintf(stderr, "sprayplan: trace: found no --rays, expected --rays FILE\n");
        return EXIT_USAGE;
    }
    sp_mesh *mesh = sp_mesh_load(options->inputs[0], 1, &error);
    sp_tracer *tracer = mesh ? sp_tracer_create(mesh, options->accelerator, options->threads, &error) : NULL;
    ray_reader reader = {.path = options->rays};
    if (tracer && !(reader.file = fopen(options->rays, "rb")))
        sp_fail(&error, SP_ERROR_INPUT, options->rays, 0, 0, "cannot be opened: %s", strerror(errno));
    bool good = reader.file && trace_file(&reader, tracer, options, &error);
    if (reader.file)
        fclose(reader.file);
    free(reader.text);
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
    return good ? EXIT_DONE : cli_fail(&error);
}
