#include "labels.h"

#include <stdlib.h>
#include <string.h>

/* Of the style's fonts, in pixels. */
#define DOT 9
#define LETTER_HEIGHT 21
#define HALO 3 /* white, around letters */
#define NUMBER_RADIUS 15

static bool is_free(const sp_labels *labels, const double box[4])
{
    bool room =
        !(labels->width > 0) || (box[0] >= 0 && box[1] >= 0 && box[2] <= labels->width && box[3] <= labels->height);
    for (size_t i = 0; room && i < labels->count; ++i) {
        const double *other = labels->box[i];
        room = box[0] >= other[2] || box[2] <= other[0] || box[1] >= other[3] || box[3] <= other[1];
    }
    return room;
}

static void take(sp_labels *labels, const double box[4])
{
    if (labels->count < SP_LABELS)
        memcpy(labels->box[labels->count++], box, sizeof labels->box[0]);
}

/* The widest that a letter is in the usual bold fonts. */
static double letter_width(char letter)
{
    if ((letter & 0xc0) == 0x80) /* UTF-8 continues with 10xxxxxx */
        return 0;
    return letter && strchr("MWmw@%", letter) ? 29 : letter && strchr("ijl.,:;'|!()[]", letter) ? 12 : 20;
}

static double text_width(const char *name)
{
    double width = 2 * HALO;
    for (; *name; ++name)
        width += letter_width(*name);
    return width;
}

#define SHARE 0.6 /* of a picture's width, that a name may take */
#define FEWEST 4  /* letters of it, that it is never cut below */

/* Cuts a name that would not go into the picture, and marks it as cut. */
static void shorten(sp_text *name, double width)
{
    size_t letters = 0;
    double most = width > 0 ? SHARE * width : INFINITY, used = 0;
    const char *at = name->text, *cut = NULL;
    for (; *at; ++at) {
        letters += (*at & 0xc0) != 0x80;
        used += letter_width(*at);
        if (used > most && letters > FEWEST && !cut && (*at & 0xc0) != 0x80)
            cut = at;
    }
    if (!cut || name->failed)
        return;
    name->length = (size_t)(cut - name->text);
    sp_text_add(name, "\xe2\x80\xa6");
}

#define WAYS 16
#define RINGS 6
#define RING 26.0 /* pixels */

/* Farther and farther around a spot until a box of that size has room, as its middle; false where none has. */
static bool find_room(const sp_labels *labels, const double spot[2], double width, double height, double at[2])
{
    for (int ring = 1; ring <= RINGS; ++ring)
        for (int k = 0; k < WAYS; ++k) {
            double turn = 2 * M_PI * k / WAYS - 0.25 * M_PI; /* to the upper right first */
            at[0] = spot[0] + (0.5 * width + RING * ring) * cos(turn);
            at[1] = spot[1] + (0.5 * height + RING * ring) * sin(turn);
            const double box[4] = {at[0] - width / 2, at[1] - height / 2, at[0] + width / 2, at[1] + height / 2};
            if (is_free(labels, box))
                return true;
        }
    return false;
}

/* From a spot to what is said of it elsewhere. */
static void add_lead(sp_text *text, const double spot[2], const double at[2])
{
    sp_text_add(text, "<path class=\"lead\" d=\"M%.1f %.1fL%.1f %.1f\"/>", spot[0], spot[1], at[0], at[1]);
}

/* Where a name begins beside its dot: on the first side that has room, else where there is some. False where there is
 * none, or where no more labels can be kept clear of: one that lies over others is worth less than none. */
static bool place_name(sp_labels *labels, sp_text *text, const char *name, const double dot[2], double at[2])
{
    double width = text_width(name), height = LETTER_HEIGHT + 4, middle[2], box[4];
    const double sides[][2] = {{12, -8}, {12, 26}, {-12 - width, -8}, {-12 - width, 26}, {-width / 2, -16}};
    if (labels->count == SP_LABELS)
        return false;
    size_t count = sizeof sides / sizeof *sides, i = 0;
    for (bool room = false; !room && i < count; i += !room) {
        at[0] = dot[0] + sides[i][0];
        at[1] = dot[1] + sides[i][1];
        memcpy(box, (const double[4]){at[0], at[1] - LETTER_HEIGHT, at[0] + width, at[1] + 4}, sizeof box);
        room = is_free(labels, box);
    }
    if (i == count) {
        if (!find_room(labels, dot, width, height, middle))
            return false;
        at[0] = middle[0] - width / 2;
        at[1] = middle[1] + height / 2 - 4;
        add_lead(text, dot, middle);
    }
    take(labels, (const double[4]){at[0], at[1] - LETTER_HEIGHT, at[0] + width, at[1] + 4});
    return true;
}

static void add_dot(sp_text *text, const double dot[2], const char *name, bool named)
{
    sp_text_add(text, "<circle class=\"nozzle\" cx=\"%.1f\" cy=\"%.1f\" r=\"7\"", dot[0], dot[1]);
    if (named) {
        sp_text_add(text, "/>");
        return;
    }
    sp_text_add(text, "><title>"); /* where the pointer rests */
    sp_markup_escape(text, name);
    sp_text_add(text, "</title></circle>\n");
}

static void add_name(sp_labels *labels, sp_text *text, const char *bytes, const double dot[2])
{
    char *whole = sp_text_utf8(bytes);
    sp_text name = {0};
    double at[2] = {0, 0};
    sp_text_add(&name, "%s", whole ? whole : "");
    text->failed |= !whole || name.failed;
    if (text->failed) {
        free(whole);
        free(name.text);
        return;
    }
    shorten(&name, labels->width);
    bool named = place_name(labels, text, name.text, dot, at);
    add_dot(text, dot, whole, named);
    free(whole);
    if (named) {
        sp_text_add(text, "<text class=\"name\" x=\"%.1f\" y=\"%.1f\">", at[0] + HALO, at[1]);
        sp_markup_escape(text, name.text);
        sp_text_add(text, "</text>\n");
    }
    text->failed |= name.failed;
    free(name.text);
}

void sp_labels_nozzles(sp_labels *labels, sp_text *text, const sp_camera *camera, const sp_layout *layout)
{
    double xy[2];
    for (size_t i = 0; i < layout->count; ++i)
        if (sp_camera_shows(camera, layout->nozzles[i].position, xy))
            take(labels, (const double[4]){xy[0] - DOT, xy[1] - DOT, xy[0] + DOT, xy[1] + DOT});
    for (size_t i = 0; i < layout->count; ++i)
        if (sp_camera_shows(camera, layout->nozzles[i].position, xy))
            add_name(labels, text, layout->nozzles[i].name, xy);
}

/* Which shadow a sample of a picture shows, from 1; 0 for none. */
static size_t shadow_at(const sp_shot *shot, const sp_listed_shadows *shadows, size_t sample)
{
    uint32_t look = shot->samples[sample].look;
    return look < shadows->patches ? shadows->number[look] : 0;
}

/* What a picture shows of a shadow. */
typedef struct {
    double x, y; /* its middle, columns and rows of samples */
    size_t samples;
    size_t left, right, top, bottom; /* columns and rows of samples, the last ones included */
} sight;

static void add_to(sight *s, size_t column, size_t row)
{
    s->left = s->samples && s->left < column ? s->left : column;
    s->top = s->samples && s->top < row ? s->top : row;
    s->right = s->right > column ? s->right : column;
    s->bottom = s->bottom > row ? s->bottom : row;
    s->x += (double)column;
    s->y += (double)row;
    s->samples++;
}

static void find_sights(const sp_shot *shot, const sp_listed_shadows *shadows, sight sights[SP_PAGE_SHADOWS])
{
    size_t columns = 2 * (size_t)shot->width, samples = columns * 2 * (size_t)shot->height;
    for (size_t k = 0; k < samples; ++k) {
        size_t number = shadow_at(shot, shadows, k);
        if (number)
            add_to(&sights[number - 1], k % columns, k / columns);
    }
    for (size_t i = 0; i < shadows->count; ++i)
        if (sights[i].samples) {
            sights[i].x /= (double)sights[i].samples;
            sights[i].y /= (double)sights[i].samples;
        }
}

static void box_around(const double at[2], double box[4])
{
    box[0] = at[0] - NUMBER_RADIUS;
    box[1] = at[1] - NUMBER_RADIUS;
    box[2] = at[0] + NUMBER_RADIUS;
    box[3] = at[1] + NUMBER_RADIUS;
}

/* The spot of a shadow that is nearest to its middle; where there is room, if there is any, else beside it. */
static void place_number(sp_labels *labels, sp_text *text, const sp_shot *shot, const sp_listed_shadows *shadows,
                         size_t number, const sight *seen, double at[2])
{
    double best[2] = {INFINITY, INFINITY}, box[4]; /* how far from the middle: without room, with room */
    for (size_t row = seen->top; row <= seen->bottom; ++row)
        for (size_t column = seen->left; column <= seen->right; ++column) {
            const double spot[2] = {labels->sample * (double)column, labels->sample * (double)row};
            double far = hypot((double)column - seen->x, (double)row - seen->y);
            if (far >= best[1] || shadow_at(shot, shadows, row * 2 * (size_t)shot->width + column) != number)
                continue;
            box_around(spot, box);
            bool room = is_free(labels, box);
            if (!room && (isfinite(best[1]) || far >= best[0]))
                continue;
            best[room] = far;
            memcpy(at, spot, sizeof spot);
        }
    const double spot[2] = {at[0], at[1]};
    if (!isfinite(best[1]) && find_room(labels, spot, 2 * NUMBER_RADIUS, 2 * NUMBER_RADIUS, at))
        add_lead(text, spot, at);
    else if (!isfinite(best[1]))
        memcpy(at, spot, sizeof spot);
    box_around(at, box);
    take(labels, box);
}

void sp_labels_shadows(sp_labels *labels, sp_text *text, const sp_shot *shot, const sp_listed_shadows *shadows)
{
    sight sights[SP_PAGE_SHADOWS] = {0};
    double at[2] = {0, 0};
    find_sights(shot, shadows, sights);
    for (size_t i = 0; i < shadows->count; ++i) {
        if (sights[i].samples == 0)
            continue;
        place_number(labels, text, shot, shadows, i + 1, &sights[i], at);
        sp_text_add(text,
                    "<circle class=\"shadow\" cx=\"%.1f\" cy=\"%.1f\" r=\"%d\"/><text class=\"number\" x=\"%.1f\" "
                    "y=\"%.1f\">%zu</text>\n",
                    at[0], at[1], NUMBER_RADIUS - 1, at[0], at[1] + 7, i + 1);
    }
}
