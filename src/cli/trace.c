/* sprayplan trace: nearest hits of lines or parabolas from a file. */
#include "cli.h"
#include "rays.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

enum { BATCH = 1 << 16 };

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

/* How much of the file has been read, where it is one; nothing where the rows on the terminal show it. */
static void report_share(const cli_options *options, FILE *file)
{
    struct stat status;
    bool known = fstat(fileno(file), &status) == 0 && S_ISREG(status.st_mode) && status.st_size > 0;
    if (!isatty(STDOUT_FILENO))
        cli_progress_share(options, "rays", known ? (double)ftello(file) / (double)status.st_size : -1);
}

static bool trace_file(cli_rays *reader, const sp_tracer *tracer, const cli_options *options, sp_error *error)
{
    sp_ray *rays = malloc(BATCH * sizeof *rays);
    sp_hit *hits = malloc(BATCH * sizeof *hits);
    size_t count = 0, total = 0;
    bool good = rays && hits;
    if (!good)
        sp_fail_memory(error);
    while (good && (good = cli_rays_read(reader, rays, BATCH, &count, error)) && count) {
        report_share(options, reader->file);
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
    if (good && total == 0)
        fprintf(stderr, "sprayplan: trace: %s holds no rays\n", reader->path);
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
    static const char *const stages[] = {"mesh", "accelerator", "rays", NULL};
    cli_progress_plan(stages, 0, 0, 1);
    cli_progress_stage(options, "mesh");
    sp_mesh *mesh = cli_load_mesh(options, &error);
    cli_progress_stage(options, "accelerator");
    sp_tracer *tracer = mesh ? sp_tracer_create(mesh, options->accelerator, options->threads, &error) : NULL;
    cli_rays reader = {.path = cli_input_name(options->rays),
                       .file = tracer ? cli_open(options->rays, &error) : NULL,
                       .gravity = options->gravity};
    cli_progress_end();
    bool good = reader.file && trace_file(&reader, tracer, options, &error);
    if (reader.file && reader.file != stdin)
        fclose(reader.file);
    free(reader.text);
    sp_tracer_destroy(tracer);
    sp_mesh_destroy(mesh);
    return good ? EXIT_DONE : cli_fail(&error);
}
