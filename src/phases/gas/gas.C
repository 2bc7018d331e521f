// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "gas.H"
#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(gas, 0);
addToRunTimeSelectionTable(surroundingPhase, gas, dictionary);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::gas::gas(const dictionary& dict, const caseScales& scales) :
    deltaT_(1)
{
    entryReader read(dict);
    const entryReader::interval& positive = entryReader::positive;

    // What the entries are made for; without it they are as they stand
    scalar stress = 1;
    scalar viscosity = 1;
    if (read.has("madeFor"))
    {
        const dictionary& sub = entryReader::subDictionary(
            dict, "madeFor", "stress and strainRate that the entries are for"
        );
        entryReader of(sub);
        const caseScales made(
            of.number("strainRate", "that the entries are for [1/s]", positive),
            of.number("stress", "that the entries are for [Pa]", positive)
        );
        of.rejectOthers();
        stress = scales.stress() / made.stress();
        viscosity = stress * made.strainRate() / scales.strainRate();
    }
    const scalar s = scales.stressRatio() / stress;
    const scalar v = scales.viscosity() / viscosity;

    zeta_ = viscosity
        * read.number("zeta", "volumetric viscosity [Pa s]", positive, 20 * v);
    eta_ =
        viscosity * read.number("eta", "shear viscosity [Pa s]", positive, v);
    etaDamaged_ = viscosity
        * read.number(
            "etaDamaged",
            "shear viscosity of damaged bolus [Pa s]",
            positive,
            20 * v
        );
    delta_ = stress
        * read.number(
            "delta", "rounding of the contact's corner [Pa]", positive, 2 * s
        );
    growthThreshold_ = read.number(
        "growthThreshold",
        "gas fraction that bolus tolerates [-]",
        {0, false, 0.4, true},
        0.4
    );
    closing_ = read.number(
        "closing",
        "largest part of the gas closed in a step [-]",
        {0, false, 1, true},
        0.5
    );
    cohesion_ = read.number(
        "cohesion",
        "tension that damaged bolus holds [Pa]",
        entryReader::nonNegative,
        0
    );
    read.rejectOthers();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::gas::start(const UList<cellStart>& cells, const scalar deltaT)
{
    deltaT_ = deltaT;
    mobility_.setSize(cells.size());
    holds_.setSize(cells.size());
    available_.setSize(cells.size());
    forAll(cells, c)
    {
        const cellStart& cell = cells[c];
        mobility_[c] = cell.damaged || cell.atWall
            ? 1
            : opening(cell.alpha) * (cell.alpha < 0.5 ? 1 : cell.sharpness);
        holds_[c] = cell.damaged && !cell.atWall ? cohesion_ : 0;
        available_[c] = cell.available;
    }
}


void Foam::gas::shrinking(
    const label c,
    const scalar alpha,
    const scalar p,
    scalar& rate,
    scalar& slope
) const
{
    const scalar open = mobility_[c];
    const scalar root = std::sqrt(p * p + delta_ * delta_);
    const scalar pt = p + holds_[c];
    const scalar rootT = std::sqrt(pt * pt + delta_ * delta_);
    const scalar minus = 0.5 * open / zeta_ * (pt - rootT);
    const scalar dMinus = 0.5 * open / zeta_ * (1 - pt / rootT);
    const scalar close = max(open, 1 - alpha) / zeta_;
    const scalar plus = 0.5 * close * (p + root);
    const scalar dPlus = 0.5 * close * (1 + p / root);

    // Written with 1/r_1, which is 0 in gas, infinite in full cells
    const scalar full = closing_ * available_[c];
    const scalar d = full + plus * alpha * deltaT_;
    const scalar part = d > VSMALL ? full / d : 0;
    rate = minus + part * plus;
    slope = dMinus + part * part * dPlus;
}


Foam::scalar Foam::gas::closingPressure(
    const label c,
    const scalar alpha,
    const scalar rate,
    const scalar largest
) const
{
    const scalar full = closing_ * available_[c];
    const scalar close = max(mobility_[c], 1 - alpha) / zeta_;
    if (close * full < VSMALL) return 0;
    const scalar left = full - rate * alpha * deltaT_;
    const scalar plus = rate * full / close;
    if (plus >= left * largest) return largest;
    const scalar y = plus / left;
    return min(y - delta_ * delta_ / (4 * y), largest);
}


Foam::scalar Foam::gas::weight(
    const label c,
    const scalar alpha,
    const scalar pressure,
    const scalar rate
) const
{
    return 1 / (1 + max(mobility_[c], 1 - alpha) * pressure / (zeta_ * rate));
}

// ************************************************************************* //
