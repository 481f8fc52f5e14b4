#include <sprayplan/nozzle.h>

#include <string.h>

bool sp_is_url(const char *text)
{
    size_t scheme = strncmp(text, "https://", 8) == 0 ? 8 : strncmp(text, "http://", 7) == 0 ? 7 : 0;
    if (!scheme || !text[scheme] || strlen(text) >= SP_URL)
        return false;
    for (const char *c = text; *c; c++)
        if ((unsigned char)*c <= ' ' || *c == 0x7f || strchr("\"'<>\\`", *c))
            return false;
    return true;
}
