#ifndef MESH_CAD_OCCT_LENGTH_UNIT_H
#define MESH_CAD_OCCT_LENGTH_UNIT_H

#include <Interface_InterfaceModel.hxx>

/* Whether all of a STEP file's shapes state in what unit their lengths are: OpenCASCADE takes mm else. */
bool sp_cad_states_length_unit(const Handle(Interface_InterfaceModel) & model);

#endif
