// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "historyTransport.H"
#include "entryReader.H"
#include "processorPolyPatch.H"
#include "transformField.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::pack()
{
    List<scalarField> all(11 + (inertia_ ? 3 : 0));
    all[0] = state_.p.primitiveField();
    all[1] = state_.epsilonPEq.primitiveField();
    all[2] = state_.D.primitiveField();
    const symmTensorField s(transform(axes_, state_.deviator.primitiveField()));
    for (direction d = 0; d < 6; ++d) all[3 + d] = s.component(d);
    all[9] = state_.soundStrain.primitiveField();
    all[10] = state_.tensileStrain.primitiveField();
    const vectorField U(transform(axes_, state_.U.primitiveField()));
    for (direction d = 0; inertia_ && d < 3; ++d) all[11 + d] = U.component(d);

    // What is nowhere stays so; the pressure moves always. Shear out of the
    // plane of a slice is round-off (1e-13 of the stress in case D)
    scalarField most(all.size());
    forAll(all, d) most[d] = gMax(mag(all[d]));
    const scalar noStress = 1e-10 * max(SubList<scalar>(most, 6, 3));
    DynamicList<label> used;
    damage_ = -1;
    forAll(all, d)
    {
        const bool stress = d >= 3 && d < 9;
        if (d != 0 && most[d] <= (stress ? noStress : 0)) continue;
        if (d == 2) damage_ = used.size();
        used.append(d);
    }
    used_ = used;

    n_ = used_.size();
    memory_.setSize(mesh_.nCells() * n_);
    forAll(used_, k)
    {
        const scalarField& q = all[used_[k]];
        forAll(q, c) memory_[c * n_ + k] = q[c];
    }
    carried_.setSize(memory_.size());
    least_.setSize(memory_.size());
    most_.setSize(memory_.size());
    start_.setSize(memory_.size());
    gradient_.setSize(3 * memory_.size());
    for (scalarField* faces : {&memoryF_, &mean_, &second_})
    {
        if (faces->size() == mesh_.nFaces() * n_) continue;
        faces->setSize(mesh_.nFaces() * n_);
        *faces = 0;
    }
}


void Foam::historyTransport::unpack()
{
    List<scalarField> all(
        11 + (inertia_ ? 3 : 0), scalarField(mesh_.nCells(), Zero)
    );
    forAll(used_, k)
    {
        scalarField& q = all[used_[k]];
        forAll(q, c) q[c] = memory_[c * n_ + k];
    }

    state_.p.primitiveFieldRef() = all[0];
    state_.epsilonPEq.primitiveFieldRef() = all[1];
    state_.D.primitiveFieldRef() = all[2];
    symmTensorField s(mesh_.nCells());
    for (direction d = 0; d < 6; ++d) s.replace(d, all[3 + d]);
    state_.deviator.primitiveFieldRef() = transform(axes_.T(), s);
    state_.soundStrain.primitiveFieldRef() = all[9];
    state_.tensileStrain.primitiveFieldRef() = all[10];
    if (inertia_)
    {
        vectorField U(mesh_.nCells());
        for (direction d = 0; d < 3; ++d) U.replace(d, all[11 + d]);
        state_.U.primitiveFieldRef() = transform(axes_.T(), U);
    }
    state_.p.correctBoundaryConditions();
    state_.epsilonPEq.correctBoundaryConditions();
    state_.D.correctBoundaryConditions();
    state_.soundStrain.correctBoundaryConditions();
    state_.tensileStrain.correctBoundaryConditions();
    state_.deviator.correctBoundaryConditions();
}


Foam::scalarField Foam::historyTransport::neighbour(
    const scalarField& cells,
    const label width
) const
{
    if (!parts_) return scalarField();
    scalarField beyond(mesh_.nFaces() - mesh_.nInternalFaces());
    forAll(coupledFaces_, i)
    {
        beyond[coupledFaces_[i]] = cells[coupledCells_[i] * width];
    }
    syncTools::swapBoundaryFaceList(mesh_, beyond);
    return beyond;
}


void Foam::historyTransport::exchange(
    const zone& z,
    const scalarField& cells,
    const label width,
    scalarField& beyond
) const
{
    if (!z.shared) return;
    sent_.setSize(coupledCells_.size() * width);
    beyond.setSize(sent_.size());
    forAll(coupledCells_, i)
    {
        for (label k = 0; k < width; ++k)
        {
            sent_[i * width + k] = cells[coupledCells_[i] * width + k];
        }
    }

    // One message to each neighbour; syncTools would take a list of all
    // boundary faces for each of the values. Coupled patches of other types
    // are refused (coupledSystem)
    const label before = Pstream::nRequests();
    for (const polyPatch& patch : mesh_.boundaryMesh())
    {
        if (!isA<processorPolyPatch>(patch) || patch.empty()) continue;
        const auto& to = refCast<const processorPolyPatch>(patch);
        const label at =
            width * coupledPlace_[patch.start() - mesh_.nInternalFaces()];
        const std::streamsize size = width * patch.size() * sizeof(scalar);
        UIPstream::read(
            Pstream::commsTypes::nonBlocking,
            to.neighbProcNo(),
            reinterpret_cast<char*>(&beyond[at]),
            size,
            to.tag(),
            to.comm()
        );
        UOPstream::write(
            Pstream::commsTypes::nonBlocking,
            to.neighbProcNo(),
            reinterpret_cast<const char*>(&sent_[at]),
            size,
            to.tag(),
            to.comm()
        );
    }
    Pstream::waitRequests(before);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::historyTransport::historyTransport(
    bolusState& state,
    const scalar bulkModulus,
    const tensor& axes,
    const bool inertia,
    const dictionary& dict
) :
    mesh_(state.alpha.mesh()),
    state_(state),
    K_(bulkModulus),
    axes_(axes),
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
    const wordList answers({"yes", "no"});
    localSubSteps_ =
        read.choice(
            "localSubSteps", "short ones for fast cells", answers, "yes"
        )
        == "yes";
    read.rejectOthers();

    const label nCells = mesh_.nCells();
    const label nFaces = mesh_.nFaces();
    for (
        scalarField* cells :
        {&V_,
            &Vold_,
            &alphaLow_,
            &alphaLeft_,
            &later_,
            &Pp_,
            &Pm_,
            &Rp_,
            &Rm_,
            &massOld_,
            &massNew_,
            &stays_,
            &calm_,
            &given_}
    )
    {
        cells->setSize(nCells, Zero);
    }
    for (
        scalarField* faces : {&flux_, &swept_, &low_, &anti_, &a_, &F_, &total_}
    )
    {
        faces->setSize(nFaces, Zero);
    }
    delta_.setSize(nFaces, Zero);
    coupled_.setSize(nFaces, false);
    full_.setSize(nFaces, false);
    heun_.setSize(nFaces, false);

    for (const fvPatch& patch : mesh_.boundary())
    {
        if (!patch.coupled()) continue;
        forAll(patch, i) coupled_[patch.start() + i] = true;
    }
    DynamicList<label> faces, cells;
    coupledPlace_.setSize(nFaces - mesh_.nInternalFaces(), -1);
    for (label f = mesh_.nInternalFaces(); f < nFaces; ++f)
    {
        if (!coupled_[f]) continue;
        coupledPlace_[f - mesh_.nInternalFaces()] = faces.size();
        faces.append(f - mesh_.nInternalFaces());
        cells.append(mesh_.faceOwner()[f]);
    }
    coupledFaces_ = faces;
    coupledCells_ = cells;
    parts_ = returnReduce(coupled_.found(true), orOp<bool>());
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::historyTransport::setFluxes(const surfaceScalarField& phiRel)
{
    // In one list; sides of the slice have no flux
    flux_ = 0;
    const volVectorField& C = mesh_.C();
    const label nInternal = mesh_.nInternalFaces();
    DynamicList<label> faces;
    for (label f = 0; f < nInternal; ++f)
    {
        flux_[f] = phiRel[f];
        delta_[f] = C[mesh_.neighbour()[f]] - C[mesh_.owner()[f]];
        faces.append(f);
    }
    forAll(mesh_.boundary(), patchi)
    {
        const fvPatch& patch = mesh_.boundary()[patchi];
        const fvsPatchScalarField& phip = phiRel.boundaryField()[patchi];
        const vectorField d(patch.delta());
        forAll(phip, i)
        {
            const label f = patch.patch().start() + i;
            flux_[f] = phip[i];
            delta_[f] = d[i];
            if (flux_[f] != 0 || coupled_[f]) faces.append(f);
        }
    }
    faces_ = faces;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::historyTransport::report Foam::historyTransport::advance(
    const surfaceScalarField& phi,
    const scalar deltaT,
    surfaceScalarField& massFlux
)
{
    surfaceScalarField& phiRel = state_.phiRel;
    phiRel = phi;
    if (mesh_.moving()) phiRel -= mesh_.phi();

    deltaT_ = deltaT;
    V0_ = mesh_.moving() ? mesh_.V0().field() : mesh_.V().field();
    V_ = V0_;
    total_ = 0;
    setFluxes(phiRel);

    report result;
    const scalarField Co(courant());
    largest(Co, result.courant, result.bulkCourant);
    // Compared as a number: it may be beyond what a label holds
    const scalar needed = std::ceil(result.courant / maxCourant_);
    result.tooFast = !(needed <= maxSubSteps_);
    result.subSteps = result.slowSubSteps = 0;
    result.alphaMax = result.spilled = 0;
    if (result.tooFast) return result;

    pack();
    scalarField& alpha = state_.alpha.primitiveFieldRef();
    const scalarField& m = state_.mass.primitiveField();

    // The solution has changed the pressure, and with it the volume
    forAll(alpha, c) alpha[c] = m[c] * std::exp(-p(c) / K_);

    const labelPair steps = divide(Co, max(label(needed), 1));
    const label coarse = steps.first();
    const label fine = steps.second();
    result.slowSubSteps = coarse;
    result.subSteps = coarse * fine;
    zone slow, fast;
    setZones(Co, fine > 1 ? coarse : labelMax, slow, fast);
    for (label i = 0; i < coarse; ++i)
    {
        // Between slow cells, with what fast ones take and give at the start
        if (fine > 1) upwind(fast);
        setBolusFlux(slow, i + 1, coarse, 1);
        setMemoryFlux(slow, deltaT / coarse);

        // Fast ones and their neighbours
        for (label j = 0; fine > 1 && j < fine; ++j)
        {
            const label sub = i * fine + j + 1;
            setBolusFlux(fast, sub, coarse * fine, fine - j);
            follow(fast, fine);
            setMemoryFlux(fast, deltaT / (coarse * fine));
            move(fast, sub, coarse * fine);
        }
        setMean(fast);
        move(slow, i + 1, coarse);
    }

    result.spilled = spill();

    unpack();
    state_.mass.correctBoundaryConditions();
    state_.alpha.correctBoundaryConditions();
    result.alphaMax = gMax(alpha);

    const label nInternal = mesh_.nInternalFaces();
    for (label f = 0; f < nInternal; ++f) massFlux[f] = total_[f];
    forAll(mesh_.boundary(), patchi)
    {
        fvsPatchScalarField& Fp = massFlux.boundaryFieldRef()[patchi];
        forAll(Fp, i)
        {
            Fp[i] = total_[mesh_.boundaryMesh()[patchi].start() + i];
        }
    }
    return result;
}

// ************************************************************************* //
