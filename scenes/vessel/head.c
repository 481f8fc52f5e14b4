/* Torispherical heads: a dome of radius `crown` that a torus of radius `knuckle` joins to the cylinder. With crown =
 * diameter and knuckle = diameter / 10 it is the Klöpper head of DIN 28011. */
#include "delaunay.h"
#include "shapes.h"

#include <stdlib.h>

head head_offset(const head *inner, double offset)
{
    head outer = *inner;
    outer.radius += offset;
    outer.crown += offset;
    outer.knuckle += offset;
    return outer;
}

/* Radius at which the dome meets the torus, and the angle of that circle from the vertical. */
static double joint_angle(const head *head)
{
    return asin((head->radius - head->knuckle) / (head->crown - head->knuckle));
}

double head_z(const head *head, double r)
{
    double joint = joint_angle(head), height;
    double torus = head->radius - head->knuckle;
    if (r < head->crown * sin(joint))
        height = sqrt(head->crown * head->crown - r * r) - (head->crown - head->knuckle) * cos(joint);
    else
        height = sqrt(fmax(0, head->knuckle * head->knuckle - (r - torus) * (r - torus)));
    return head->tangent_z + head->direction * height;
}

/* Length of the meridian from the apex to radius r: the radius of the plan in which triangles keep their shape,
 * although the knuckle stands upright. And its inverse. */
static double meridian(const head *head, double r)
{
    double joint = joint_angle(head);
    if (r < head->crown * sin(joint))
        return head->crown * asin(r / head->crown);
    double sine = fmin(1, (r - head->radius + head->knuckle) / head->knuckle);
    return head->crown * joint + head->knuckle * (asin(sine) - joint);
}

static double meridian_radius(const head *head, double s)
{
    double joint = joint_angle(head), dome = head->crown * joint;
    if (s < dome)
        return head->crown * sin(s / head->crown);
    return head->radius - head->knuckle + head->knuckle * sin(joint + (s - dome) / head->knuckle);
}

typedef struct {
    double (*plan)[2]; /* in the stretched plan */
    sp_vec3 *position;
    int *opening; /* whose rim it is, or -1 */
    int count;
} cloud;

static void add(cloud *cloud, const head *head, double x, double y, int opening)
{
    double r = hypot(x, y), stretch = r > 0 ? meridian(head, r) / r : 1;
    cloud->plan[cloud->count][0] = stretch * x;
    cloud->plan[cloud->count][1] = stretch * y;
    cloud->position[cloud->count] = sp_v(x, y, head_z(head, r));
    cloud->opening[cloud->count++] = opening;
}

static void add_openings(cloud *cloud, const head *head, const circle *openings, int count)
{
    for (int i = 0; i < count; ++i) {
        for (int j = 0; j < openings[i].segments; ++j) {
            sp_vec3 p = circle_corner(&openings[i], j, 0);
            add(cloud, head, p.x, p.y, i);
        }
        /* The rim's points lie on one circle, which alone would have no Delaunay triangulation of its own. */
        add(cloud, head, openings[i].x, openings[i].y, i);
    }
}

static bool clear_of_openings(const circle *openings, int count, double x, double y, double size)
{
    for (int i = 0; i < count; ++i) {
        double spacing = 2 * M_PI * openings[i].r / openings[i].segments;
        if (hypot(x - openings[i].x, y - openings[i].y) < openings[i].r + fmin(0.7 * size, 2 * spacing))
            return false;
    }
    return true;
}

/* Rings of points, every ring turned by the golden angle against the one before, so that no four lie on a circle. */
static void add_rings(cloud *cloud, const head *head, const circle *openings, int opening_count, int segments,
                      double size)
{
    double length = meridian(head, head->radius);
    int rings = (int)ceil(length / size);
    circle rim = {0, 0, head->radius, segments};
    for (int i = 0; i < segments; ++i) {
        sp_vec3 p = circle_corner(&rim, i, 0);
        add(cloud, head, p.x, p.y, -1);
    }
    for (int ring = 0; ring < rings; ++ring) {
        double s = length * ring / rings, r = meridian_radius(head, s);
        int points = ring == 0 ? 1 : (int)ceil(2 * M_PI * s / size);
        for (int i = 0; i < points; ++i) {
            double angle = 2 * M_PI * i / points + 2.399963229728653 * ring;
            double x = r * cos(angle), y = r * sin(angle);
            if (clear_of_openings(openings, opening_count, x, y, size))
                add(cloud, head, x, y, -1);
        }
    }
}

static int most_points(const head *head, const circle *openings, int opening_count, int segments, double size)
{
    int rings = (int)ceil(meridian(head, head->radius) / size);
    int points = segments + 1;
    for (int ring = 1; ring < rings; ++ring)
        points += (int)ceil(2 * M_PI * ring) + 1;
    for (int i = 0; i < opening_count; ++i)
        points += openings[i].segments + 1;
    return points;
}

static void emit(model *model, const cloud *cloud, int (*triangles)[3], int count, bool upward)
{
    for (int i = 0; i < count; ++i) {
        const int *t = triangles[i];
        const int *opening = cloud->opening;
        if (opening[t[0]] >= 0 && opening[t[0]] == opening[t[1]] && opening[t[1]] == opening[t[2]])
            continue; /* within the opening */
        const sp_vec3 *p = cloud->position;
        sp_vec3 corners[3] = {p[t[0]], p[t[upward ? 1 : 2]], p[t[upward ? 2 : 1]]};
        model_face(model, corners, 3);
    }
}

bool head_surface(model *model, const head *head, const circle *openings, int opening_count, int segments, double size,
                  bool upward)
{
    size_t most = (size_t)most_points(head, openings, opening_count, segments, size);
    cloud cloud = {malloc(most * sizeof *cloud.plan), malloc(most * sizeof *cloud.position),
                   malloc(most * sizeof *cloud.opening), 0};
    int(*triangles)[3] = NULL;
    int count = 0;
    if (cloud.plan && cloud.position && cloud.opening) {
        add_openings(&cloud, head, openings, opening_count);
        add_rings(&cloud, head, openings, opening_count, segments, size);
        triangles = delaunay(cloud.plan, cloud.count, &count);
    }
    if (triangles)
        emit(model, &cloud, triangles, count, upward);
    bool made = triangles != NULL;
    free(triangles);
    free(cloud.plan);
    free(cloud.position);
    free(cloud.opening);
    return made;
}
