// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"
#include "contactPatches.H"
#include "entryReader.H"
#include "linearOptions.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::coupledSystem::freeze()
{
    cells_.start(deltaT_);

    const laminate& mixture = cells_.mixture();
    forAll(weight_, c)
    {
        weight_[c] = mixture.medium().weight(
            c, mixture.alphaEff(c), unknowns_.P0, unknowns_.rate0
        );
    }

    solved_ = gasLayers_ == 0;
    if (gasLayers_ > 0)
    {
        forAll(solved_, c) solved_[c] = mixture.alphaEff(c) > 0;
        for (label layer = 0; layer < gasLayers_; ++layer)
        {
            space_.grow(solved_);
        }
        space_.solveOnly(solved_);
    }
}


bool Foam::coupledSystem::attempt()
{
    // Not from where one before it has failed, which may be anywhere
    unknowns_.start(
        state_.pointU.primitiveField(),
        state_.pStart.primitiveField(),
        solved_,
        accuracy()
    );
    cells_.forgetTangent();
    const bool converged = newton_.solve(unknowns_.x());
    report_.iterations += newton_.iterations();
    return converged;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::coupledSystem::coupledSystem(
    const elastoViscoPlastic& law,
    surroundingPhase& medium,
    bolusState& state,
    const caseScales& scales,
    const dictionary& bolusProperties,
    const dictionary& dict,
    entryReader&& read
) :
    law_(law),
    state_(state),
    explicitPressureBelow_(read.number(
        "explicitPressureBelow",
        "longest step whose friction may be lagged [s]",
        entryReader::nonNegative,
        1e-3 * scales.time()
    )),
    damageAbove_(read.number(
        "damageAbove",
        "alpha above which bolus can break [-]",
        {0, true, 1, true},
        0.1
    )),
    gasLayers_(read.wholeNumber(
        "gasLayers",
        "of cells around the bolus",
        {0, true, 1e6, true},
        0
    )),
    space_(state.alpha.mesh(), contactPatches::kinds(state.U)),
    cells_(law, medium, state, space_, scales, bolusProperties, read),
    unknowns_(space_, cells_, scales),
    turning_(state.alpha.time(), scales, read),
    newton_(*this, dict, read),
    deltaT_(1),
    solved_(state.alpha.size(), true),
    weight_(state.alpha.size(), 1.0)
{
    const linearOptions linear(dict, read);
    read.rejectOthers();

    const unknownLayout& layout = unknowns_.layout();
    tangent_.reset(new condensedTangent(
        space_, layout.scatter(), layout.local(), linear.slabs()
    ));
    newton_.create(unknowns_.x(), tangent_->matrix(), linear.tolerance());
    tangent_->attach(newton_.snes());
    petscCheck(
        SNESSetFromOptions(newton_.snes()), "petscOptions of fvSolution"
    );

    solution_.power.declare("walls");
    solution_.power.declare("closure");
    cells_.declare(solution_.power);
    solution_.slipEnergy = 0;
    solution_.bolusRate = 0;
    solution_.flowRate = 0;
}


Foam::coupledSystem::coupledSystem(
    const elastoViscoPlastic& law,
    surroundingPhase& medium,
    bolusState& state,
    const caseScales& scales,
    const dictionary& bolusProperties,
    const dictionary& dict
) :
    coupledSystem(
        law,
        medium,
        state,
        scales,
        bolusProperties,
        dict,
        entryReader(dict)
    )
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

const Foam::coupledSystem::report& Foam::coupledSystem::solve(
    const scalar deltaT
)
{
    deltaT_ = deltaT;
    space_.update(deltaT);
    freeze();

    cells_.friction().lag(false);
    turning_.start(deltaT);
    cells_.mixture().turnLater(turning_.now());
    report_.iterations = 0;
    bool converged = attempt();

    // Turning may take more stress from what shears than strain gives it
    if (!converged && turning_.mayHelp(deltaT))
    {
        turning_.begin();
        cells_.mixture().turnLater(true);
        converged = attempt();
    }

    // Where the threshold of a face falls faster than its load as it begins to
    // slip, there is no equilibrium to be found: the thing snaps. A threshold
    // that waits for the next step leaves one
    if (!converged && cells_.friction().rubs()
        && deltaT <= explicitPressureBelow_)
    {
        cells_.friction().lag(true);
        converged = attempt();
    }
    report_.explicitPressure = cells_.friction().lagged();
    report_.rotationSplit = turning_.now();
    report_.converged = converged;
    report_.reason = newton_.reason();

    // Bolus that is shut in may find balance at any pressure: where that is a
    // multiple of the bulk modulus, nothing that follows can be right
    scalar most = 0;
    forAll(solved_, c)
    {
        if (cells_.mixture().alphaEff(c) > 0)
        {
            most = max(most, mag(unknowns_.p()[c]));
        }
    }
    const scalar strain =
        returnReduce(most, maxOp<scalar>()) / law_.elastic().K();
    if (report_.converged && strain > 100)
    {
        report_.converged = false;
        report_.reason = "pressureOf100BulkModuli";
    }
    return report_;
}

// ************************************************************************* //
