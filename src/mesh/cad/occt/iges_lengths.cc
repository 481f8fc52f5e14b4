/* An IGES file says in what unit its lengths are by a flag and by a name, and of what scale its model is. OpenCASCADE
 * goes by the flag, where that is 0 or 3 by the name, and leaves the scale out. */
#include "iges_lengths.h"

#include <IGESData_BasicEditor.hxx>
#include <TCollection_HAsciiString.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace
{

enum { INCH = 1, BY_NAME = 3, LAST = 11 }; // flags
const int SHOWN = 20;                      // bytes of a name, so that what is said of it is not cut

TCollection_AsciiString name_of(const IGESData_GlobalSection &global)
{
    TCollection_AsciiString name;
    if (!global.UnitName().IsNull())
        name = global.UnitName()->String();
    name.LeftAdjust();
    name.RightAdjust();
    name.Trunc(std::min(name.Length(), SHOWN));
    return name;
}

/* 0 of a name that is not known. */
int flag_of(TCollection_AsciiString name)
{
    name.UpperCase();
    return IGESData_BasicEditor::UnitNameFlag(name.ToCString());
}

/* Nothing where all is well. A flag is BY_NAME still where OpenCASCADE does not know the name, and INCH where there was
 * neither flag nor name. */
std::string doubt_of_unit(int flag, const TCollection_AsciiString &name)
{
    const std::string shown = std::string("\"") + name.ToCString() + "\"",
                      taken = IGESData_BasicEditor::UnitFlagName(flag);
    if (flag == BY_NAME)
        return "the unit of length " + shown + " is not known, mm are taken";
    if (name.IsEmpty())
        return flag == INCH ? "no unit of length is named, inches are taken" : "";
    if (flag_of(name) != flag)
        return "the unit of length is " + taken + " by its flag, " + shown + " by its name: " + taken + " is taken";
    return "";
}

/* The ratio of lengths in the file to real ones. */
std::string doubt_of_scale(double scale)
{
    char text[100];
    if (scale == 1)
        return "";
    snprintf(text, sizeof text,
             scale > 0 && std::isfinite(scale)
                 ? "the model space scale of %.9g is not applied: real lengths are these divided by it"
                 : "the model space scale of %.9g is none, 1 is taken",
             scale);
    return text;
}

} // namespace

std::vector<std::string> sp_cad_doubtful_lengths(const IGESData_GlobalSection &global)
{
    int flag = global.UnitFlag();
    TCollection_AsciiString name = name_of(global);
    if (flag < INCH || flag > LAST)
        throw std::runtime_error("found the flag " + std::to_string(flag) + " and the name \"" + name.ToCString() +
                                 "\" for its unit of length, expected a flag from 1 to 11");
    std::vector<std::string> doubts;
    for (const std::string &doubt : {doubt_of_unit(flag, name), doubt_of_scale(global.Scale())})
        if (!doubt.empty())
            doubts.push_back(doubt);
    return doubts;
}
