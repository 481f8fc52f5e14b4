#ifndef MESH_CAD_OCCT_REVOLVED_H
#define MESH_CAD_OCCT_REVOLVED_H

#include <Interface_InterfaceModel.hxx>

/* Of each circle or ellipse that is turned about one of its own axes, half, from pole to pole. To be called before
 * anything is made of the file's entities. */
void sp_cad_halve_revolved(const Handle(Interface_InterfaceModel) & model);

#endif
