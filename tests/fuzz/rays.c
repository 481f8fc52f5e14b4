/* Files of rays. */
#include "rays.h"
#include "target.h"

enum { ROOM = 5 }; /* few, so that files go over their end */

bool target_accepted;

/* What is written with 17 digits is the same ray. */
static void require_same(const sp_ray *ray)
{
    char text[200];
    int length = snprintf(text, sizeof text, "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g", ray->origin.x, ray->origin.y,
                          ray->origin.z, ray->velocity.x, ray->velocity.y, ray->velocity.z);
    sp_error error = {0};
    sp_ray again;
    size_t count;
    cli_rays reader = {.path = "again", .file = fmemopen(text, (size_t)length, "rb")};
    REQUIRE(reader.file && cli_rays_read(&reader, &again, 1, &count, &error) && count == 1);
    REQUIRE(memcmp(&again.origin, &ray->origin, sizeof again.origin) == 0);
    REQUIRE(memcmp(&again.velocity, &ray->velocity, sizeof again.velocity) == 0);
    fclose(reader.file);
    free(reader.text);
}

static void require_sound(const sp_ray *ray)
{
    double speed = sp_length(ray->velocity);
    REQUIRE(isfinite(sp_length(ray->origin)) && speed > 0 && isfinite(speed));
    REQUIRE(ray->t_min == 0 && isinf(ray->t_max) && ray->skip == SP_NONE);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    sp_error error = {0};
    sp_ray rays[ROOM];
    size_t count, lines = 1;
    meter_start();
    cli_rays reader = {.path = "strange", .file = fmemopen((void *)data, size, "rb")};
    REQUIRE(reader.file);
    while ((target_accepted = cli_rays_read(&reader, rays, ROOM, &count, &error)) && count) {
        for (size_t i = 0; i < count; i++)
            require_sound(&rays[i]);
        if (reader.line == 1 || count < ROOM)
            require_same(&rays[count - 1]);
    }
    require_frugal(size);
    for (size_t i = 0; i < size; i++)
        lines += data[i] == '\n';
    REQUIRE(reader.line >= 0 && (size_t)reader.line <= lines);
    REQUIRE(target_accepted == (error.kind == SP_OK));
    if (!target_accepted)
        require_located(&error, "strange", data, size);
    fclose(reader.file);
    free(reader.text);
    return 0;
}
