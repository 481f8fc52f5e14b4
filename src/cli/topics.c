#include "topics.h"

const cli_topic cli_topics[] = {
    {NULL, NULL, NULL},
};
