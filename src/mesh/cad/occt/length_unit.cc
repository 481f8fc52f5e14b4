#include "length_unit.h"

#include <StepBasic_ConversionBasedUnitAndLengthUnit.hxx>
#include <StepBasic_LengthUnit.hxx>
#include <StepBasic_SiUnitAndLengthUnit.hxx>
#include <StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx.hxx>
#include <StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext.hxx>
#include <StepRepr_GlobalUnitAssignedContext.hxx>

namespace
{

/* Of the two kinds of context that shapes are in; null for anything else. */
Handle(StepRepr_GlobalUnitAssignedContext) units_of(const Handle(Standard_Transient) & entity)
{
    Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx) rough =
        Handle(StepGeom_GeomRepContextAndGlobUnitAssCtxAndGlobUncertaintyAssCtx)::DownCast(entity);
    Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext) exact =
        Handle(StepGeom_GeometricRepresentationContextAndGlobalUnitAssignedContext)::DownCast(entity);
    if (!rough.IsNull())
        return rough->GlobalUnitAssignedContext();
    return exact.IsNull() ? Handle(StepRepr_GlobalUnitAssignedContext)() : exact->GlobalUnitAssignedContext();
}

bool has_length(const Handle(StepRepr_GlobalUnitAssignedContext) & units)
{
    for (int i = 1; i <= units->NbUnits(); i++) {
        Handle(StepBasic_NamedUnit) unit = units->UnitsValue(i);
        if (!unit.IsNull() && (unit->IsKind(STANDARD_TYPE(StepBasic_LengthUnit)) ||
                               unit->IsKind(STANDARD_TYPE(StepBasic_SiUnitAndLengthUnit)) ||
                               unit->IsKind(STANDARD_TYPE(StepBasic_ConversionBasedUnitAndLengthUnit))))
            return true;
    }
    return false;
}

} // namespace

bool sp_cad_states_length_unit(const Handle(Interface_InterfaceModel) & model)
{
    bool any = false;
    for (int i = 1; i <= model->NbEntities(); i++) {
        Handle(StepRepr_GlobalUnitAssignedContext) units = units_of(model->Value(i));
        if (units.IsNull())
            continue;
        any = true;
        if (!has_length(units))
            return false;
    }
    return any;
}
