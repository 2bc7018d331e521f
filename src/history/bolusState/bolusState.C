// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "bolusState.H"

// * * * * * * * * * * * * * * Static Functions  * * * * * * * * * * * * * * //

namespace Foam
{

//- Stop if a field of a start has values below 0 or above the highest, but for
//  round-off
static void requireWithin(
    const volScalarField& f,
    const scalar highest,
    const char* valid
)
{
    const scalar roundOff = 1e-6;
    const scalar low = gMin(f.primitiveField());
    const scalar high = gMax(f.primitiveField());
    if (low < -roundOff || high > highest + roundOff)
    {
        FatalErrorInFunction << "field " << f.name() << ": values from " << low
                             << " to " << high << "; valid are " << valid
                             << exit(FatalError);
    }
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::bolusState::bolusState(const fvMesh& mesh, const scalar bulkModulus) :
    history(mesh),
    alpha(history.required<scalar>("alpha")),
    U(history.required<vector>("U")),
    p(history.cells<scalar>("p", dimPressure, 0, historyVariable::PRESSURE)),
    mass(history.cells<scalar>("mass", dimless, 0)),
    deviator(history.cells<symmTensor>(
        "deviator",
        dimPressure,
        Zero,
        historyVariable::CARRIED
    )),
    epsilonPEq(history
            .cells<scalar>("epsilonPEq", dimless, 0, historyVariable::CARRIED)),
    D(history.cells<scalar>("D", dimless, 0, historyVariable::DAMAGE)),
    undamagedStrain(history.cells<scalar>(
        "undamagedStrain",
        dimless,
        0,
        historyVariable::CARRIED
    )),
    tensileStrain(history.cells<scalar>(
        "tensileStrain",
        dimless,
        0,
        historyVariable::CARRIED
    )),
    theta(history.cells<scalar>("theta", dimless, 1)),
    pStart(history.like("pStart", p)),
    pointU(history.points("pointU", dimVelocity)),
    stress(history.cells<symmTensor>("stress", dimPressure, Zero)),
    elasticSlip(history.walls<vector>("elasticSlip", dimLength)),
    phiRel(history.faces("phiRel", dimVolume / dimTime))
{
    // What is there without a memory is a start: transport may leave a cell
    // overfull, people may not
    if (!history["mass"].found())
    {
        requireWithin(alpha, 1, "0 (gas) to 1 (bolus)");
        requireWithin(D, 1, "0 (sound) to 1 (damaged)");
        requireWithin(epsilonPEq, GREAT, "numbers >= 0");
        requireWithin(tensileStrain, GREAT, "numbers >= 0");
        mass =
            alpha * exp(p / dimensionedScalar("K", dimPressure, bulkModulus));
    }
    mass.correctBoundaryConditions();

    if (!history["undamagedStrain"].found())
        undamagedStrain = (1 - D) * epsilonPEq;
    undamagedStrain.correctBoundaryConditions();
}

// ************************************************************************* //
