#include "mesh/siphash.h"

#include <sys/random.h>

sp_hash_key sp_hash_key_draw(void)
{
    sp_hash_key key;
#ifdef __linux__
    return getrandom(&key, sizeof key, 0) == sizeof key ? key : (sp_hash_key){{0, 0}};
#else
    return getentropy(&key, sizeof key) == 0 ? key : (sp_hash_key){{0, 0}};
#endif
}
