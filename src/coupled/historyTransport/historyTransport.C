// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"
#include "planarInterface.H"
#include "nodalSpace.H"
#include "entryReader.H"
#include "labelIOList.H"
#include "syncTools.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::pack()
{
    q_.setSize(11 + (inertia_ ? 3 : 0));
    q_[0] = state_.p.primitiveField();
    q_[1] = state_.epsilonPEq.primitiveField();
    q_[2] = state_.D.primitiveField();
    q_[9] = state_.soundStrain.primitiveField();
    q_[10] = state_.tensileStrain.primitiveField();
    for (direction d = 0; d < 6; ++d)
    {
        q_[3 + d] = state_.deviator.primitiveField().component(d);
    }
    if (inertia_)
    {
        for (direction d = 0; d < 3; ++d)
        {
            q_[11 + d] = state_.U.primitiveField().component(d);
        }
    }
}


void Foam::historyTransport::unpack()
{
    state_.p.primitiveFieldRef() = q_[0];
    state_.epsilonPEq.primitiveFieldRef() = q_[1];
    state_.D.primitiveFieldRef() = q_[2];
    state_.soundStrain.primitiveFieldRef() = q_[9];
    state_.tensileStrain.primitiveFieldRef() = q_[10];
    for (direction d = 0; d < 6; ++d)
    {
        state_.deviator.primitiveFieldRef().replace(d, q_[3 + d]);
    }
    if (inertia_)
    {
        for (direction d = 0; d < 3; ++d)
        {
            state_.U.primitiveFieldRef().replace(d, q_[11 + d]);
        }
    }
    state_.p.correctBoundaryConditions();
    state_.epsilonPEq.correctBoundaryConditions();
    state_.D.correctBoundaryConditions();
    state_.soundStrain.correctBoundaryConditions();
    state_.tensileStrain.correctBoundaryConditions();
    state_.deviator.correctBoundaryConditions();
}


Foam::scalarField Foam::historyTransport::neighbour(
    const scalarField& cells
) const
{
    scalarList beyond;
    syncTools::swapBoundaryCellList(mesh_, cells, beyond);
    return scalarField(std::move(beyond));
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::historyTransport::historyTransport(
    bolusState& state,
    const scalar bulkModulus,
    const bool inertia,
    const dictionary& dict
) :
    mesh_(state.alpha.mesh()),
    state_(state),
    K_(bulkModulus),
    inertia_(inertia),
    patch_(mesh_.boundaryMesh().patchID())
{
    entryReader read(dict);
    maxCourant_ = read.number(
        "maxCourant",
        "Courant number of a sub-step [-]",
        {0, false, 0.5, true},
        0.3
    );
    maxSubSteps_ = label(
        read.number("maxSubSteps", "sub-steps", {1, true, 1e6, true}, 1000)
    );
    maxAlpha_ = read.number(
        "maxAlpha", "fullest cell of a step [-]", {1, false, GREAT, true}, 1.2
    );
    squeeze_ = read.number(
        "squeeze",
        "beyond 1, what full cells take of what fits nowhere [-]",
        {0, false, 0.1, true},
        0.005
    );
    memoryAbove_ = read.number(
        "memoryAbove",
        "alpha of cells between which memory is interpolated [-]",
        {0, true, 1, false},
        0.05
    );
    interfaceJump_ = read.number(
        "interfaceJump",
        "of alpha at an interface [-]",
        {0, false, 1, true},
        0.2
    );
    read.rejectOthers();
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::historyTransport::courant(
    const surfaceScalarField& phiRel,
    const scalar dt,
    scalar& largest,
    scalar& bulk
) const
{
    scalarField out(mesh_.nCells(), Zero);
    forAll(mesh_.neighbour(), f)
    {
        const scalar phi = phiRel[f];
        out[phi > 0 ? mesh_.owner()[f] : mesh_.neighbour()[f]] += mag(phi);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        forAll(phiRel.boundaryField()[patchi], i)
        {
            const scalar phi = phiRel.boundaryField()[patchi][i];
            if (phi > 0) out[patch.faceCells()[i]] += phi;
        }
    }

    // Classes of a twentieth of a decade, from 0.001 to 1000
    scalarList classes(120, Zero);
    const scalarField& V = mesh_.V();
    largest = 0;
    forAll(out, c)
    {
        if (state_.mass[c] < 1e-9) continue;
        const scalar Vmin = mesh_.moving() ? min(V[c], mesh_.V0()[c]) : V[c];
        const scalar Co = out[c] * dt / Vmin;
        largest = max(largest, Co);
        const label i =
            label(std::floor(20 * (std::log10(max(Co, scalar(1e-3))) + 3)));
        classes[min(i, classes.size() - 1)] += state_.mass[c] * V[c];
    }
    reduce(largest, maxOp<scalar>());
    Pstream::listCombineGather(classes, plusEqOp<scalar>());
    Pstream::listCombineScatter(classes);

    const scalar total = sum(classes);
    scalar above = 0;
    label i = classes.size() - 1;
    while (i > 0 && above + classes[i] < 0.01 * total) above += classes[i--];
    bulk = min(largest, std::pow(10.0, (i + 1) / 20.0 - 3));
}


Foam::scalar Foam::historyTransport::spill(
    scalarField& total,
    const scalar deltaT
)
{
    // First to where there is room; where the bolus around is full, it takes
    // a little more than fits
    const label nFirst = 5;
    const label nPasses = 100;
    const scalar tolerance = 1e-4;
    const scalar squeezed = 1 + squeeze_;
    const label nInternal = mesh_.nInternalFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V = mesh_.V();
    const scalarField VNei(neighbour(V));
    scalarField& m = state_.mass.primitiveFieldRef();
    scalarField& alpha = state_.alpha.primitiveFieldRef();

    if (gMax(alpha) < 1 + tolerance) return 0;

    // Faces that let something pass
    boolList open(mesh_.nFaces(), true);
    for (const fvPatch& patch : mesh_.boundary())
    {
        forAll(patch, i) open[patch.start() + i] = patch.coupled();
    }
    if (mesh_.foundObject<labelIOList>("closedPoints"))
    {
        boolList closed(mesh_.nPoints(), false);
        for (const label p : mesh_.lookupObject<labelIOList>("closedPoints"))
        {
            closed[p] = true;
        }
        forAll(open, f)
        {
            bool all = true;
            for (const label p : mesh_.faces()[f]) all = all && closed[p];
            if (all) open[f] = false;
        }
    }

    scalar spilled = 0;
    for (label pass = 0; pass < nPasses; ++pass)
    {
        const bool first = pass < nFirst;
        if (gMax(alpha) < (first ? 1 + tolerance : 1 + 1.8 * squeeze_))
        {
            break;
        }

        // Room of the cells; excess goes where there is room, in proportion
        scalarField room(V.size());
        forAll(room, c) room[c] = max(1 - alpha[c], scalar(0)) * V[c];
        const scalarField roomNei(neighbour(room));

        scalarField around(V.size(), Zero);
        forAll(own, f)
        {
            if (!open[f]) continue;
            if (f < nInternal)
            {
                const label N = mesh_.faceNeighbour()[f];
                around[own[f]] += room[N];
                around[N] += room[own[f]];
            }
            else
            {
                around[own[f]] += roomNei[f - nInternal];
            }
        }

        // Part of the cell's excess per volume of room; half of the room at
        // most, because other cells may want it too
        scalarField share(V.size(), Zero);
        scalarField excess(V.size(), Zero);
        forAll(share, c)
        {
            const scalar e = alpha[c] - 1;
            if (first && e > 0.1 * tolerance && around[c] > VSMALL)
            {
                share[c] = min(e * V[c] / around[c], scalar(0.5));
            }
            if (!first) excess[c] = max(alpha[c] - squeezed, scalar(0));
        }
        const scalarField shareNei(neighbour(share));
        const scalarField excessNei(neighbour(excess));

        // Mass over the faces, with the density of where it comes from
        scalarField rho(V.size());
        forAll(rho, c) rho[c] = std::exp(q_[0][c] / K_);
        const scalarField rhoNei(neighbour(rho));
        scalarField F(own.size(), Zero);
        forAll(own, f)
        {
            if (!open[f]) continue;
            const label P = own[f];
            const bool internal = f < nInternal;
            const label b = f - nInternal;
            const label N = internal ? mesh_.faceNeighbour()[f] : -1;
            const scalar rhoN = internal ? rho[N] : rhoNei[b];
            F[f] = share[P] * rho[P] * (internal ? room[N] : roomNei[b])
                - (internal ? share[N] : shareNei[b]) * rhoN * room[P];

            // What is beyond "squeezed" levels out, a twelfth a face: stable
            // with up to six faces
            const scalar level =
                excess[P] - (internal ? excess[N] : excessNei[b]);
            F[f] += level * min(V[P], internal ? V[N] : VNei[b]) / 12
                * (level > 0 ? rho[P] : rhoN);

            if (F[f] > 0)
                spilled += F[f];
            else if (internal)
                spilled -= F[f];
            total[f] += F[f] / deltaT;
        }

        scalarField mNew(m * V);
        forAll(F, f)
        {
            mNew[own[f]] -= F[f];
            if (f < nInternal) mNew[mesh_.faceNeighbour()[f]] += F[f];
        }
        for (scalarField& q : q_)
        {
            const scalarField qNei(neighbour(q));
            scalarField mq(m * V * q);
            forAll(F, f)
            {
                if (F[f] == 0) continue;
                const bool internal = f < nInternal;
                const label N = internal ? mesh_.faceNeighbour()[f] : -1;
                const scalar qF = F[f] > 0 ? q[own[f]]
                    : internal             ? q[N]
                                           : qNei[f - nInternal];
                mq[own[f]] -= F[f] * qF;
                if (internal) mq[N] += F[f] * qF;
            }
            forAll(q, c) q[c] = mNew[c] > 1e-12 * V[c] ? mq[c] / mNew[c] : 0;
        }
        m = mNew / V;
        forAll(alpha, c) alpha[c] = m[c] * std::exp(-q_[0][c] / K_);
    }

    return returnReduce(spilled, sumOp<scalar>());
}


void Foam::historyTransport::setSwept(
    const scalarField& alpha,
    const scalarField& alphaNei,
    const scalarField& flux,
    const vectorField& delta,
    const vectorField& g,
    const scalarField& dtByV,
    scalarField& swept
) const
{
    const label nInternal = mesh_.nInternalFaces();

    auto extent = [&](const label c, const vector& dir)
    { return nodalSpace::extent(mesh_, mesh_.points(), c, dir); };

    // By the processor of the donor cell, which tells the other one
    forAll(flux, f)
    {
        const bool internal = f < nInternal;
        const bool forward = flux[f] > 0;
        if (!internal && !forward) continue;
        const label P = mesh_.faceOwner()[f];
        const label D = forward ? P : mesh_.faceNeighbour()[f];
        swept[f] = alpha[D];
        if (alpha[D] < 1e-9 || alpha[D] > 1 - 1e-9 || flux[f] == 0) continue;

        const vector e =
            (forward ? 1 : -1) / max(mag(delta[f]), VSMALL) * delta[f];
        const vector tangential = g[D] - (g[D] & e) * e;
        const scalar steep = mag(tangential);
        const scalar along = (g[D] & e) * extent(D, e);
        const scalar across =
            steep > VSMALL ? steep * extent(D, tangential / steep) : 0;
        swept[f] = planarInterface::swept(
            alpha[D], along, across, min(mag(flux[f]) * dtByV[D], scalar(1))
        );

        // Where alpha varies but little there is no interface, and broken
        // bolus is a heap of crumbs, not a body with a surface: there nothing
        // may become steeper than it is
        const scalar aA = !internal ? alphaNei[f - nInternal]
            : forward               ? alpha[mesh_.faceNeighbour()[f]]
                                    : alpha[P];
        const scalar within =
            min(max(swept[f], min(alpha[D], aA)), max(alpha[D], aA));
        const scalar sound = min(max(1 - q_[2][D], scalar(0)), scalar(1));
        const scalar sharp =
            sound * min((mag(along) + across) / interfaceJump_, scalar(1));
        swept[f] = sharp * swept[f] + (1 - sharp) * within;
    }

    SubList<scalar> here(swept, mesh_.nFaces() - nInternal, nInternal);
    scalarField there(here);
    syncTools::swapBoundaryFaceList(mesh_, there);
    forAll(there, b)
    {
        if (flux[nInternal + b] <= 0) here[b] = there[b];
    }
}


Foam::historyTransport::report Foam::historyTransport::advance(
    const surfaceScalarField& phi,
    const scalar deltaT,
    surfaceScalarField& massFlux
)
{
    surfaceScalarField& phiRel = state_.phiRel;
    phiRel = phi;
    if (mesh_.moving()) phiRel -= mesh_.phi();

    report result;
    courant(phiRel, deltaT, result.courant, result.bulkCourant);
    // Compared as a number: it may be beyond what a label holds
    const scalar needed = std::ceil(result.courant / maxCourant_);
    result.tooFast = !(needed <= maxSubSteps_);
    result.subSteps = 0;
    result.alphaMax = result.spilled = 0;
    if (result.tooFast) return result;
    result.subSteps = max(label(needed), 1);
    const scalar dt = deltaT / result.subSteps;

    const label nCells = mesh_.nCells();
    const label nInternal = mesh_.nInternalFaces();
    const label nFaces = mesh_.nFaces();
    const labelList& own = mesh_.faceOwner();
    const scalarField& V1 = mesh_.V();
    const scalarField V0(mesh_.moving() ? mesh_.V0().field() : V1);

    // Faces in one list; sides of the slice have no flux
    scalarField flux(nFaces, Zero);
    boolList coupled(nFaces, false);
    vectorField delta(nFaces, Zero);
    const volVectorField& C = mesh_.C();
    for (label f = 0; f < nInternal; ++f)
    {
        flux[f] = phiRel[f];
        delta[f] = C[mesh_.neighbour()[f]] - C[mesh_.owner()[f]];
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const fvsPatchScalarField& phip = phiRel.boundaryField()[patchi];
        const vectorField d(patch.delta());
        forAll(phip, i)
        {
            const label f = patch.patch().start() + i;
            flux[f] = phip[i];
            coupled[f] = patch.coupled();
            delta[f] = d[i];
        }
    }

    pack();
    scalarField& m = state_.mass.primitiveFieldRef();
    scalarField& alpha = state_.alpha.primitiveFieldRef();

    // The solution has changed the pressure, and with it the volume
    forAll(alpha, c) alpha[c] = m[c] * std::exp(-q_[0][c] / K_);

    scalarField total(nFaces, Zero);

    scalarField V(V0);
    scalarField swept(nFaces, Zero), low(nFaces), anti(nFaces), F(nFaces);
    scalarField alphaLow(nCells), alphaLeft(nCells), Pp(nCells), Pm(nCells),
        Rp(nCells);
    scalarField Rm(nCells);
    vectorField g(nCells);

    const boolList all(nFaces, true);
    boolList full(nFaces);

    for (label sub = 1; sub <= result.subSteps; ++sub)
    {
        const scalarField Vold(V);
        V = V0 + (scalar(sub) / result.subSteps) * (V1 - V0);

        const scalarField alphaNei(neighbour(alpha));
        const scalarField pNei(neighbour(q_[0]));
        gradient(alpha, alphaNei, all, g);

        setSwept(alpha, alphaNei, flux, delta, g, dt / Vold, swept);

        // Bolus over the faces, by upwinding and beyond it
        forAll(flux, f)
        {
            const label P = own[f];
            const scalar aN = f < nInternal ? alpha[mesh_.neighbour()[f]]
                : coupled[f]                ? alphaNei[f - nInternal]
                                            : 0; // void comes in
            low[f] = flux[f] * (flux[f] > 0 ? alpha[P] : aN);
            anti[f] =
                f < nInternal || coupled[f] ? flux[f] * swept[f] - low[f] : 0;
        }

        // Limit what goes beyond upwinding. What leaves a cell may not count
        // on what comes in, which may be less compressed
        alphaLow = alpha * Vold / V;
        alphaLeft = alphaLow;
        Pp = 0;
        Pm = 0;
        forAll(flux, f)
        {
            const label P = own[f];
            alphaLow[P] -= low[f] * dt / V[P];
            alphaLeft[P] -= max(low[f], scalar(0)) * dt / V[P];
            (anti[f] > 0 ? Pm : Pp)[P] += mag(anti[f]) * dt / V[P];
            if (f < nInternal)
            {
                const label N = mesh_.neighbour()[f];
                alphaLow[N] += low[f] * dt / V[N];
                alphaLeft[N] += min(low[f], scalar(0)) * dt / V[N];
                (anti[f] > 0 ? Pp : Pm)[N] += mag(anti[f]) * dt / V[N];
            }
        }
        forAll(alphaLow, c)
        {
            Rp[c] = Pp[c] > VSMALL
                ? min(max(1 - alphaLow[c], scalar(0)) / Pp[c], scalar(1))
                : 1;
            Rm[c] = Pm[c] > VSMALL
                ? min(max(alphaLeft[c], scalar(0)) / Pm[c], scalar(1))
                : 1;
        }
        const scalarField RpNei(neighbour(Rp));
        const scalarField RmNei(neighbour(Rm));

        // Flux of mass: the donor's compression goes with it
        forAll(flux, f)
        {
            const label P = own[f];
            const bool internal = f < nInternal;
            const label b = f - nInternal;
            scalar a = low[f];
            if (anti[f] != 0)
            {
                const label N = internal ? mesh_.neighbour()[f] : -1;
                const scalar RpN = internal ? Rp[N] : RpNei[b];
                const scalar RmN = internal ? Rm[N] : RmNei[b];
                a +=
                    anti[f] * (anti[f] > 0 ? min(Rm[P], RpN) : min(Rp[P], RmN));
            }
            if (a == 0)
            {
                F[f] = 0;
                continue;
            }
            const scalar pD = flux[f] > 0 ? q_[0][P]
                : internal                ? q_[0][mesh_.neighbour()[f]]
                                          : pNei[b];
            F[f] = a * std::exp(pD / K_);
            total[f] += F[f] / result.subSteps;
        }
        // Memory is interpolated only between cells with bolus
        forAll(F, f)
        {
            const scalar aN = f < nInternal ? alpha[mesh_.neighbour()[f]]
                : coupled[f]                ? alphaNei[f - nInternal]
                                            : 0;
            full[f] = min(alpha[own[f]], aN) > memoryAbove_;
        }

        const scalarField mOld(m);
        m *= Vold;
        forAll(F, f)
        {
            m[own[f]] -= F[f] * dt;
            if (f < nInternal) m[mesh_.neighbour()[f]] += F[f] * dt;
        }
        m /= V;

        moveMemory(F, dt, mOld * Vold, m * V, delta, full);

        forAll(alpha, c) alpha[c] = m[c] * std::exp(-q_[0][c] / K_);
    }

    result.spilled = spill(total, deltaT);

    unpack();
    state_.mass.correctBoundaryConditions();
    state_.alpha.correctBoundaryConditions();
    result.alphaMax = gMax(alpha);

    for (label f = 0; f < nInternal; ++f) massFlux[f] = total[f];
    forAll(mesh_.boundary(), patchi)
    {
        fvsPatchScalarField& Fp = massFlux.boundaryFieldRef()[patchi];
        forAll(Fp, i)
        {
            Fp[i] = total[mesh_.boundaryMesh()[patchi].start() + i];
        }
    }
    return result;
}

// ************************************************************************* //
