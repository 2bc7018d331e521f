// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "sweptBolus.H"
#include "leastSquaresGradient.H"
#include "nodalSpace.H"
#include "planarInterface.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::sweptBolus::sweptBolus(
    const fvMesh& mesh,
    const cellExchange& exchange,
    const stepFlux& step,
    const packedHistory& memory,
    entryReader& read
) :
    mesh_(mesh),
    exchange_(exchange),
    step_(step),
    memory_(memory),
    interfaceJump_(read.number(
        "interfaceJump",
        "of alpha at an interface [-]",
        {0, false, 1, true},
        0.2
    )),
    swept_(mesh.nFaces(), Zero),
    gradient_(3 * mesh.nCells(), Zero)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::sweptBolus::set(
    const transportZone& z,
    const scalarField& alpha,
    const scalarField& alphaBeyond,
    const scalar dt
)
{
    const label nInternal = mesh_.nInternalFaces();
    leastSquaresGradient::set(
        mesh_,
        exchange_,
        z,
        alpha,
        alphaBeyond,
        1,
        [](const label) { return true; },
        gradient_
    );

    // By the processor of the donor cell, which tells the other one
    for (const label f : z.faces)
    {
        const bool internal = f < nInternal;
        const scalar flux = step_.flux(f);
        const bool forward = flux > 0;
        if (!internal && !(exchange_.coupled(f) && forward)) continue;
        const label P = mesh_.faceOwner()[f];
        const label D = step_.donor(f);
        swept_[f] = alpha[D];
        if (alpha[D] < 1e-9 || alpha[D] > 1 - 1e-9 || flux == 0) continue;

        const vector e = step_.direction(f);
        const vector g(
            gradient_[3 * D], gradient_[3 * D + 1], gradient_[3 * D + 2]
        );
        const vector tangential = g - (g & e) * e;
        const scalar steep = mag(tangential);
        const scalar along = (g & e) * step_.extent(f, e);
        const scalar across = steep > VSMALL ? steep
                * nodalSpace::extent(
                    mesh_, mesh_.points(), D, tangential / steep
                )
                                             : 0;
        swept_[f] = planarInterface::swept(
            alpha[D],
            along,
            across,
            min(mag(flux) * (dt / step_.Vold(D)), scalar(1))
        );

        const scalar aA = !internal ? alphaBeyond[exchange_.at(f)]
            : forward               ? alpha[mesh_.faceNeighbour()[f]]
                                    : alpha[P];
        const scalar within =
            min(max(swept_[f], min(alpha[D], aA)), max(alpha[D], aA));
        const scalar sound =
            min(max(1 - memory_.damage(D), scalar(0)), scalar(1));
        const scalar sharp =
            sound * min((mag(along) + across) / interfaceJump_, scalar(1));
        swept_[f] = sharp * swept_[f] + (1 - sharp) * within;
    }

    if (!z.shared) return;
    exchange_.faces(swept_, sweptBeyond_);
    for (const label f : z.faces)
    {
        if (exchange_.coupled(f) && step_.flux(f) <= 0)
        {
            swept_[f] = sweptBeyond_[exchange_.at(f)];
        }
    }
}

// ************************************************************************* //
