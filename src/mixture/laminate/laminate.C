// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "laminate.H"
#include "entryReader.H"
#include "surfaceFields.H"
#include "volFields.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::scalar Foam::laminate::viscosity(
    const label c,
    const scalar shearRate
) const
{
    const scalar a = alphaEff_[c];
    return (1 - a) * medium_.viscosity(shearRate)
        + (damaged_[c] ? a * medium_.damagedViscosity() : 0);
}


Foam::scalar Foam::laminate::viscosity(const label c, const tensor& gradU) const
{
    return viscosity(
        c,
        medium_.shearThins() ? std::sqrt(2.0) * mag(dev(symm(gradU)))
                             : typicalRate_
    );
}


Foam::scalarField Foam::laminate::inflow() const
{
    const volScalarField& alpha = state_.alpha;
    const fvMesh& mesh = alpha.mesh();
    scalarField in(mesh.nCells(), Zero);
    auto add = [&](const label c, const scalar out, const scalar alphaN)
    {
        if (out < 0) in[c] -= out * max(alphaN - alpha[c], scalar(0));
    };
    const surfaceScalarField& phi = state_.phiRel;
    const labelUList& own = mesh.owner();
    const labelUList& nei = mesh.neighbour();
    forAll(nei, f)
    {
        add(own[f], phi[f], alpha[nei[f]]);
        add(nei[f], -phi[f], alpha[own[f]]);
    }
    forAll(mesh.boundary(), patchi)
    {
        const fvPatch& patch = mesh.boundary()[patchi];
        if (!patch.coupled()) continue;
        const scalarField alphaN(
            alpha.boundaryField()[patchi].patchNeighbourField()
        );
        forAll(patch, i)
        {
            add(patch.faceCells()[i],
                phi.boundaryField()[patchi][i],
                alphaN[i]);
        }
    }
    return in;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::laminate::laminate(
    const elastoViscoPlastic& law,
    surroundingPhase& medium,
    const bolusState& state,
    const nodalSpace& space,
    const cellInterface& interface,
    const caseScales& scales,
    entryReader& read
) :
    law_(law),
    medium_(medium),
    state_(state),
    space_(space),
    interface_(interface),
    typicalRate_(scales.strainRate()),
    overshootTime_(read.number(
        "overshootTime",
        "in which alpha > 1 expands [s]",
        entryReader::positive,
        0.04 * scales.time()
    )),
    leastAvailable_(read.number(
        "leastAvailable",
        "part of a gas that may close [-]",
        {0, true, 1, true},
        0.05
    )),
    emptyBelow_(read.number(
        "emptyBelow",
        "alpha that carries nothing [-]",
        {0, true, 1, true},
        1e-6
    )),
    deltaT_(1),
    turnLater_(false),
    alphaEff_(space.mesh().nCells(), Zero),
    overshoot_(space.mesh().nCells(), Zero),
    pOld_(space.mesh().nCells(), Zero),
    damaged_(space.mesh().nCells(), false)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::laminate::start(const scalar deltaT)
{
    deltaT_ = deltaT;
    pOld_ = state_.p.primitiveField();

    const volScalarField& alpha = state_.alpha;
    const scalarField in(inflow());
    List<surroundingPhase::cellStart> cells(alpha.size());
    forAll(alpha, c)
    {
        scalar a = min(max(alpha[c], scalar(0)), scalar(1));
        if (a < emptyBelow_) a = 0;
        alphaEff_[c] = a;
        damaged_[c] = state_.D[c] > 0.5;
        overshoot_[c] = max(alpha[c] - 1, scalar(0)) / overshootTime_;

        // What the step may close: less what the last velocity would fill
        surroundingPhase::cellStart& cell = cells[c];
        cell.available =
            max(1 - a - in[c] * deltaT_ / space_.V()[c],
                leastAvailable_ * (1 - a));
        cell.alpha = alpha[c];
        cell.alphaEff = a;
        cell.sharpness = interface_.sharpness()[c];
        cell.damaged = damaged_[c];
        cell.atWall = interface_.atWall(c);
        cell.p = state_.pStart[c];
    }
    medium_.start(cells, deltaT_);
}


void Foam::laminate::evaluate(
    const label c,
    const tensor& gradU,
    const scalar dilation,
    const scalar p,
    result& r
) const
{
    const scalar a = alphaEff_[c];
    const scalar expansion = -(p - pOld_[c]) / (K() * deltaT_);
    r.gradU = gradU;
    r.p = p;
    r.growth = dilation - a * expansion - overshoot_[c];
    r.apart = dilation - expansion - overshoot_[c];

    if (a > SMALL)
    {
        law_.update(
            seen(ofBolus(c, gradU, r.apart)),
            deltaT_,
            state_.deviator[c],
            state_.epsilonPEq[c],
            damaged_[c],
            r.r
        );
    }
    else
    {
        r.r.s = Zero;
    }

    r.pv = p - (interface_.N()[c] && r.r.s);
    scalar rate;
    medium_.shrinking(c, a, r.pv, rate, r.slope);
    r.residual = r.growth + rate;

    r.P = -(a * p + (1 - a) * r.pv);
    r.eta = viscosity(c, gradU);
    r.dev = a * r.r.s + (2 * r.eta) * dev(symm(gradU));
}


void Foam::laminate::derive(
    const label c,
    const result& r,
    const tensor& dGradU,
    const scalar dDilation,
    derivative& d
) const
{
    const scalar a = alphaEff_[c];
    d.growth = dDilation;
    d.s = Zero;
    if (a > SMALL)
    {
        d.s = law_.tangent(seen(ofBolus(c, dGradU, d.growth)), r.r);
    }
    d.pv = -(interface_.N()[c] && d.s);
    d.P = -((1 - a) * d.pv);
    const scalar V = space_.V()[c];
    const symmTensor dD(dev(symm(dGradU)));
    d.dev = (a * V) * d.s + (2 * V * r.eta) * dD;
    if (medium_.shearThins())
    {
        const symmTensor D(dev(symm(r.gradU)));
        const scalar rate = std::sqrt(2.0) * mag(D);
        if (rate > VSMALL)
        {
            d.dev += (4 * V * (1 - a) * medium_.viscositySlope(rate) * (D && dD)
                         / rate)
                * D;
        }
    }
}


void Foam::laminate::deriveToPressure(
    const label c,
    const result& r,
    derivative& d
) const
{
    const scalar a = alphaEff_[c];
    d.growth = a / (K() * deltaT_);
    d.s = Zero;
    if (a > SMALL)
    {
        const scalar apart = 1 / (K() * deltaT_);
        d.s = law_.tangent(seen(ofBolus(c, Zero, apart)), r.r);
    }
    d.pv = 1 - (interface_.N()[c] && d.s);
    d.P = -(a + (1 - a) * d.pv);
    d.dev = (a * space_.V()[c]) * d.s;
}


Foam::symmTensor Foam::laminate::turned(const label c, const result& r) const
{
    elastoViscoPlastic::response whole;
    law_.update(
        ofBolus(c, r.gradU, r.apart),
        deltaT_,
        state_.deviator[c],
        state_.epsilonPEq[c],
        damaged_[c],
        whole
    );
    return mag(r.r.s) / max(mag(whole.s), VSMALL) * whole.s;
}


Foam::scalar Foam::laminate::stiffness(const label c) const
{
    return viscosity(c, typicalRate_)
        + alphaEff_[c] * max(state_.theta[c], scalar(1e-3)) * law_.elastic().G()
        * deltaT_;
}


Foam::scalar Foam::laminate::rho(const label c) const
{
    return rhoBolus() * state_.mass[c]
        + (medium_.rho() > 0
                ? medium_.rho() * max(1 - state_.alpha[c], scalar(0))
                : 0);
}

// ************************************************************************* //
