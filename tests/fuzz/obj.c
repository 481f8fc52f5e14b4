/* OBJ files. */
#include "mesh.h"

bool target_accepted;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    read_mesh(sp_obj_read, data, size);
    return 0;
}
