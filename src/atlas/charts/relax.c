/* As-rigid-as-possible flattening, local and global step in turn: L. Liu, L. Zhang, Y. Xu, C. Gotsman and S. J.
 * Gortler, "A Local/Global Approach to Mesh Parameterization" (2008). The global step, a sparse linear system, is
 * carried some way by conjugate gradients with the diagonal as preconditioner; from one round to the next little is
 * left to do. */
#include "atlas/charts/relax.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static bool reserve(sp_relaxer *r, size_t vertices, size_t triangles)
{
    if (vertices <= r->capacity && triangles <= r->triangle_capacity)
        return true;
    sp_relaxer_destroy(r);
    vertices += vertices / 2;
    triangles += triangles / 2;
    r->residual = malloc(vertices * sizeof *r->residual);
    r->move = malloc(vertices * sizeof *r->move);
    r->search = malloc(vertices * sizeof *r->search);
    r->image = malloc(vertices * sizeof *r->image);
    r->diagonal = malloc(vertices * sizeof *r->diagonal);
    r->triangles = malloc(triangles * sizeof *r->triangles);
    if (!r->residual || !r->move || !r->search || !r->image || !r->diagonal || !r->triangles) {
        sp_relaxer_destroy(r);
        return false;
    }
    r->capacity = vertices;
    r->triangle_capacity = triangles;
    return true;
}

void sp_relaxer_destroy(sp_relaxer *r)
{
    free(r->residual);
    free(r->move);
    free(r->search);
    free(r->image);
    free(r->diagonal);
    free(r->triangles);
    *r = (sp_relaxer){0};
}

/* The triangles as they are gone through, and the inverse of the diagonal of the Laplacian. */
static void gather(sp_relaxer *r, const sp_sheets *sheets, const sp_sheet *sheet)
{
    for (size_t v = 0; v < sheet->vertex_count; v++)
        r->diagonal[v] = 0;
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        sp_relaxed_triangle *t = &r->triangles[i];
        const uint32_t *c = sheet->corner[i];
        memcpy(t->shape, sheets->shape[sheet->triangle[i]], sizeof t->shape);
        for (int k = 0; k < 3; k++)
            t->weight[k] = sheets->weight[sheet->triangle[i]][k];
        r->diagonal[c[0]] += t->weight[0] + t->weight[2];
        r->diagonal[c[1]] += t->weight[0] + t->weight[1];
        r->diagonal[c[2]] += t->weight[1] + t->weight[2];
    }
    for (size_t v = 0; v < sheet->vertex_count; v++)
        r->diagonal[v] = r->diagonal[v] > 1e-9 ? 1 / r->diagonal[v] : 1;
}

static inline sp_plane place_of(const sp_sheet *sheet, uint32_t vertex)
{
    return (sp_plane){sheet->at[vertex][0], sheet->at[vertex][1]};
}

/* x and y change places, and then times a. */
static inline sp_plane across(sp_plane p, sp_plane a)
{
    return (sp_plane){p[1], p[0]} * a;
}

/* Local step: turns each triangle's own shape as it lies best, and sums up how far its edges are from that. */
static void find_residual(sp_relaxer *r, const sp_sheet *sheet)
{
    memset(r->residual, 0, sheet->vertex_count * sizeof *r->residual);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        const double *shape = r->triangles[i].shape, *w = r->triangles[i].weight;
        const uint32_t *c = sheet->corner[i];
        sp_plane p0 = place_of(sheet, c[0]), p1 = place_of(sheet, c[1]), p2 = place_of(sheet, c[2]);
        sp_plane u0 = p1 - p0, u1 = p2 - p1, u2 = p0 - p2;
        double ex1 = shape[1] - shape[0], ex2 = -shape[1];
        sp_plane left = {-shape[2], shape[2]}, right = {shape[2], -shape[2]};
        /* The rotation nearest to Σ w u eᵀ, in closed form: cosine and sine. */
        sp_plane turn =
            w[0] * u0 * shape[0] + w[1] * (u1 * ex1 + across(u1, right)) + w[2] * (u2 * ex2 + across(u2, left));
        double length = sqrt(turn[0] * turn[0] + turn[1] * turn[1]);
        turn *= length > 0 ? 1 / length : 0;
        sp_plane f0 = w[0] * (turn * shape[0] - u0);
        sp_plane f1 = w[1] * (turn * ex1 + across(turn, left) - u1);
        sp_plane f2 = w[2] * (turn * ex2 + across(turn, right) - u2);
        r->residual[c[0]] += f2 - f0;
        r->residual[c[1]] += f0 - f1;
        r->residual[c[2]] += f1 - f2;
    }
}

/* image = Laplacian × search */
static void apply(sp_relaxer *r, const sp_sheet *sheet)
{
    sp_plane *restrict image = r->image;
    const sp_plane *restrict search = r->search;
    memset(image, 0, sheet->vertex_count * sizeof *image);
    for (size_t i = 0; i < sheet->triangle_count; i++) {
        const double *w = r->triangles[i].weight;
        const uint32_t *c = sheet->corner[i];
        sp_plane p0 = search[c[0]], p1 = search[c[1]], p2 = search[c[2]];
        sp_plane f0 = w[0] * (p0 - p1), f1 = w[1] * (p1 - p2), f2 = w[2] * (p2 - p0);
        image[c[0]] += f0 - f2;
        image[c[1]] += f1 - f0;
        image[c[2]] += f2 - f1;
    }
}

/* Conjugate gradients on residual = Laplacian × move, both coordinates side by side. */
static void solve(sp_relaxer *r, const sp_sheet *sheet, int steps)
{
    size_t count = sheet->vertex_count;
    sp_plane rho = {0, 0};
    for (size_t v = 0; v < count; v++) {
        r->move[v] = (sp_plane){0, 0};
        r->search[v] = r->diagonal[v] * r->residual[v];
        rho += r->search[v] * r->residual[v];
    }
    sp_plane least = 1e-4 * rho;
    for (int step = 0; step < steps && (rho[0] > least[0] || rho[1] > least[1]); step++) {
        apply(r, sheet);
        sp_plane slope = {0, 0}, next = {0, 0}, alpha, beta;
        for (size_t v = 0; v < count; v++)
            slope += r->search[v] * r->image[v];
        for (int k = 0; k < 2; k++)
            alpha[k] = slope[k] > 0 ? rho[k] / slope[k] : 0;
        for (size_t v = 0; v < count; v++) {
            r->move[v] += alpha * r->search[v];
            r->residual[v] -= alpha * r->image[v];
            next += r->diagonal[v] * r->residual[v] * r->residual[v];
        }
        for (int k = 0; k < 2; k++)
            beta[k] = rho[k] > 0 ? next[k] / rho[k] : 0;
        rho = next;
        for (size_t v = 0; v < count; v++)
            r->search[v] = r->diagonal[v] * r->residual[v] + beta * r->search[v];
    }
}

bool sp_relax(sp_relaxer *relaxer, const sp_sheets *sheets, sp_sheet *sheet, int rounds, int inner)
{
    if (!reserve(relaxer, sheet->vertex_count, sheet->triangle_count))
        return false;
    gather(relaxer, sheets, sheet);
    for (int round = 0; round < rounds; round++) {
        find_residual(relaxer, sheet);
        solve(relaxer, sheet, inner);
        for (size_t v = 0; v < sheet->vertex_count; v++)
            for (int k = 0; k < 2; k++)
                sheet->at[v][k] += relaxer->move[v][k];
    }
    return true;
}
