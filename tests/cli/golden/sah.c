/* Whichever accelerator is asked for, the kd-tree by the surface area heuristic is built. */
#include <sprayplan/trace.h>

/* The linker's names for the library's and for what is called in its place. */
sp_tracer *__real_sp_tracer_create(const sp_mesh *mesh, sp_accelerator accelerator, int threads, sp_error *error);
sp_tracer *__wrap_sp_tracer_create(const sp_mesh *mesh, sp_accelerator accelerator, int threads, sp_error *error);

sp_tracer *__wrap_sp_tracer_create(const sp_mesh *mesh, sp_accelerator accelerator, int threads, sp_error *error)
{
    (void)accelerator;
    return __real_sp_tracer_create(mesh, SP_ACCELERATOR_SAH, threads, error);
}
