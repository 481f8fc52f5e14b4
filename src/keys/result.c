/* The keys of result.json. */
#include "keys/blocks.h"
static const sp_key result_keys[] = {{NULL}};
const sp_block sp_block_result = {"result", "a result", NULL, result_keys};
