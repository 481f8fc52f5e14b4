#ifndef MESH_CAD_OCCT_IGES_LENGTHS_H
#define MESH_CAD_OCCT_IGES_LENGTHS_H

#include <IGESData_GlobalSection.hxx>

#include <string>
#include <vector>

/* What is doubtful in what an IGES file says of its lengths, a text each. Throws std::runtime_error where the flag of
 * their unit is none: OpenCASCADE makes nothing of such a file, and does not say why. */
std::vector<std::string> sp_cad_doubtful_lengths(const IGESData_GlobalSection &global);

#endif
