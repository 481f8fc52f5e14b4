/* Finding a topic or a key. */
#include "keys/blocks.h"

#include <assert.h>
#include <string.h>

const sp_block *sp_topic_block(sp_topic topic)
{
    static const sp_block *const blocks[] = {&sp_block_scene, &sp_block_catalogue, &sp_block_result, &sp_block_files,
                                             &sp_block_outputs};
    return (unsigned)topic < sizeof blocks / sizeof *blocks ? blocks[topic] : NULL;
}

const sp_key *sp_key_of(const sp_block *block, const char *name)
{
    const sp_key *key = block->keys;
    while (key->name && strcmp(key->name, name) != 0)
        key++;
    assert(key->name);
    return key;
}
