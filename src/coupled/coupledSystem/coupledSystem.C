// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "coupledSystem.H"
#include "contactWallFvPatchVectorField.H"
#include "frictionless.H"
#include "emptyPolyPatch.H"
#include "entryReader.H"
#include "fvcGrad.H"
#include "processorPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "syncTools.H"
#include "unitConversion.H"
#include "wallPolyPatch.H"
#include "wedgePolyPatch.H"

#include <functional>

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::coupledSystem::isSymmetry(const polyPatch& pp)
{
    return isA<symmetryPlanePolyPatch>(pp) || isA<symmetryPolyPatch>(pp);
}


Foam::List<Foam::nodalSpace::patchKind> Foam::coupledSystem::kinds(
    const volVectorField& U
)
{
    const polyBoundaryMesh& bm = U.mesh().boundaryMesh();
    List<nodalSpace::patchKind> result(bm.size());

    forAll(bm, patchi)
    {
        const polyPatch& pp = bm[patchi];
        const fvPatchVectorField& Up = U.boundaryField()[patchi];

        if (isA<wedgePolyPatch>(pp) || isA<emptyPolyPatch>(pp)
            || isA<processorPolyPatch>(pp))
        {
            result[patchi] = nodalSpace::SLICE;
        }
        else if (isSymmetry(pp))
        {
            result[patchi] = nodalSpace::NORMAL;
        }
        else if (pp.coupled())
        {
            FatalErrorInFunction
                << "patch " << pp.name() << " of type " << pp.type()
                << ": valid are wall, patch, symmetry, symmetryPlane, wedge,"
                << " empty and processor" << exit(FatalError);
        }
        else if (isA<contactWallFvPatchVectorField>(Up))
        {
            // Else it has no normal for the bolus to part along
            if (!isA<wallPolyPatch>(pp))
            {
                FatalErrorInFunction
                    << "field U, patch " << pp.name() << ": entry type:"
                    << " contactWall, and the patch is of type " << pp.type()
                    << "; valid is type wall in constant/polyMesh/boundary"
                    << exit(FatalError);
            }
            result[patchi] = refCast<const contactWallFvPatchVectorField>(Up)
                                 .friction()
                                 .sticks()
                ? nodalSpace::FULL
                : nodalSpace::NORMAL;
        }
        else if (Up.type() == "zeroGradient" && !isA<wallPolyPatch>(pp))
        {
            result[patchi] = nodalSpace::UNCONSTRAINED;
        }
        else
        {
            FatalErrorInFunction
                << "field U, patch " << pp.name() << " (" << pp.type()
                << "): entry type: " << Up.type() << "; valid are contactWall"
                << " (a wall with or without friction) and, where the patch is"
                << " no wall, zeroGradient (an open boundary)"
                << exit(FatalError);
        }
    }
    return result;
}


void Foam::coupledSystem::setContact()
{
    const polyBoundaryMesh& bm = mesh_.boundaryMesh();

    friction_.setSize(bm.size(), nullptr);
    separates_.setSize(mesh_.nCells(), false);
    contactFaces_.setSize(mesh_.nCells());
    contactPatches_.setSize(mesh_.nCells());

    forAll(bm, patchi)
    {
        const fvPatchVectorField& Up = state_.U.boundaryField()[patchi];
        if (!isA<contactWallFvPatchVectorField>(Up)) continue;

        const contactWallFvPatchVectorField& wall =
            refCast<const contactWallFvPatchVectorField>(Up);
        if (!wall.friction().sticks())
        {
            friction_[patchi] = &wall.friction();
            if (!isA<frictionless>(wall.friction())) rubs_ = true;
        }

        const labelList& cells = bm[patchi].faceCells();
        forAll(cells, i)
        {
            if (wall.separation()) separates_[cells[i]] = true;
            if (friction_[patchi])
            {
                contactFaces_[cells[i]].append(bm[patchi].start() + i);
                contactPatches_[cells[i]].append(patchi);
            }
        }
    }
}


void Foam::coupledSystem::freeze()
{
    const volScalarField& alpha = state_.alpha;
    const label nCells = mesh_.nCells();

    N_.setSize(nCells);
    a_.setSize(nCells);
    phi_.setSize(nCells);
    room_.setSize(nCells);
    cohesion_.setSize(nCells);
    weight_.setSize(nCells);
    overfill_.setSize(nCells);
    damaged_.setSize(nCells);
    hourglassEta_.setSize(nCells);
    eta_.setSize(nCells);
    pOld_ = state_.p.primitiveField();
    UOld_ = state_.U.primitiveField();

    // Void that the step may close: less what the last velocity would fill
    scalarField inflow(nCells, Zero);
    {
        auto add = [&](const label c, const scalar out, const scalar alphaN)
        {
            if (out < 0) inflow[c] -= out * max(alphaN - alpha[c], scalar(0));
        };
        const surfaceScalarField& phi = state_.phiRel;
        const labelUList& own = mesh_.owner();
        const labelUList& nei = mesh_.neighbour();
        forAll(nei, f)
        {
            add(own[f], phi[f], alpha[nei[f]]);
            add(nei[f], -phi[f], alpha[own[f]]);
        }
        forAll(mesh_.boundary(), patchi)
        {
            const fvPatch& patch = mesh_.boundary()[patchi];
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
    }

    const scalar G = law_.elastic().G();
    const volVectorField gradAlpha(fvc::grad(alpha));

    forAll(alpha, c)
    {
        const scalar a = min(max(alpha[c], scalar(0)), scalar(1));
        a_[c] = a < emptyBelow_ ? 0 : a;
        damaged_[c] = state_.D[c] > 0.5;
        room_[c] =
            max(1 - a_[c] - inflow[c] * deltaT_ / space_.V()[c],
                leastRoom_ * (1 - a_[c]));
        overfill_[c] = 0.5 * max(alpha[c] - 1, scalar(0)) / overfillTime_;

        const bool atWall =
            separates_[c] && magSqr(space_.cellWallNormal()[c]) > 0;
        // Interface where alpha varies over the cell
        vector n = gradAlpha[c];
        if (space_.nd() == 2) n -= (n & space_.normal()) * space_.normal();
        const scalar magN = mag(n);
        const scalar h = space_.cellSize(c, n / max(magN, VSMALL));
        scalar sharp = min(magN * h / interfaceJump_, scalar(1));
        phi_[c] = damaged_[c] || atWall
            ? 1
            : void_.opening(alpha[c]) * (alpha[c] < 0.5 ? 1 : sharp);
        cohesion_[c] = damaged_[c] && !atWall ? void_.cohesion() : 0;

        const vector& nw = space_.cellWallNormal()[c];
        if (atWall && (nw & state_.stress[c] & nw) > partingTension_)
        {
            sharp = 0;
        }
        weight_[c] =
            1 / (1 + max(phi_[c], 1 - a_[c]) * P0_ / (void_.zeta() * rate0_));
        const symmTensor interface =
            magN > SMALL ? sqr(n / magN) : symmTensor(Zero);
        const symmTensor otherwise =
            atWall ? sqr(nw) : symmTensor((1.0 / 3.0) * symmTensor::I);
        N_[c] = sharp * interface + (1 - sharp) * otherwise;

        eta_[c] = (1 - a_[c]) * void_.eta()
            + (damaged_[c] ? a_[c] * void_.etaDamaged() : 0);
        hourglassEta_[c] = hourglass_
            * (eta_[c]
                + a_[c] * max(state_.theta[c], scalar(1e-3)) * G * deltaT_);
    }

    solved_.setSize(nCells);
    solved_ = voidLayers_ == 0;
    if (voidLayers_ > 0)
    {
        forAll(a_, c) solved_[c] = a_[c] > 0;
        for (label layer = 0; layer < voidLayers_; ++layer)
        {
            space_.grow(solved_);
        }
        space_.solveOnly(solved_);
    }
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::coupledSystem::coupledSystem(
    const elastoViscoPlastic& law,
    const voidLaw& voids,
    bolusState& state,
    const caseScales& scales,
    const dictionary& dict
) :
    mesh_(state.alpha.mesh()),
    law_(law),
    void_(voids),
    state_(state),
    rubs_(false),
    lagged_(false),
    memory_(IOobject(
        "coupledSystem",
        mesh_.time().timeName(),
        "uniform",
        mesh_.time(),
        IOobject::READ_IF_PRESENT,
        IOobject::AUTO_WRITE
    )),
    turnLaterRow_(memory_.lookupOrDefault<label>("turnLaterRow", 0)),
    turnLater_(memory_.lookupOrDefault<label>("turnLater", 0)),
    turningLagged_(false),
    space_(mesh_, kinds(state.U)),
    elasticSlip_(state.elasticSlip),
    deltaT_(1),
    q_(space_.nd() * space_.nNodes(), Zero),
    pCell_(mesh_.nCells(), Zero),
    secant_(true),
    eliminate_(true),
    shift_(mesh_.nCells(), Zero),
    sLast_(mesh_.nCells(), Zero),
    U0_(0.01 * scales.strainRate()),
    P0_(1e4 * scales.stressRatio()),
    rate0_(10 * scales.strainRate()),
    bolusRate_(0),
    flowRate_(0)
{

    entryReader read(dict);
    const entryReader::interval& positive = entryReader::positive;
    const entryReader::interval& nonNegative = entryReader::nonNegative;

    tolerance_ = read.number(
        "tolerance",
        "rms of the scaled residuals [-]",
        {0, false, 1e-2, true},
        1e-6
    );
    maxIterations_ = read.wholeNumber(
        "maxIterations", "of Newton's method", {1, true, 1e5, true}, 60
    );
    fullSteps_ = read.wholeNumber(
        "fullSteps", "iterations without line search", {0, true, 1e5, true}, 0
    );
    lagFrictionBelow_ = read.number(
        "lagFrictionBelow",
        "longest step whose friction may be lagged [s]",
        nonNegative,
        1e-3 * scales.time()
    );
    lagTurningBelow_ = read.number(
        "lagTurningBelow",
        "longest step whose turning of the stress may be lagged [s]",
        nonNegative,
        1e-3 * scales.time()
    );
    lagTurningSteps_ = read.wholeNumber(
        "lagTurningSteps",
        "most steps in a row whose turning of the stress is lagged",
        {leastLagTurningSteps_, true, 1e5, true},
        leastLagTurningSteps_
    );
    closingPressure_ = read.number(
        "closingPressure",
        "to which one iteration may close a void [Pa]",
        nonNegative,
        0
    );
    hourglass_ =
        read.number("hourglass", "hourglass control [-]", nonNegative, 0.05);
    overfillTime_ = read.number(
        "overfillTime",
        "in which alpha > 1 expands [s]",
        positive,
        0.02 * scales.time()
    );
    inertia_ =
        read.number("inertia", "density scale of inertia [-]", nonNegative, 0);
    partingTension_ = read.number(
        "partingTension",
        "tension at which a wall cell parts from the wall [Pa]",
        nonNegative,
        0.1 * scales.stressRatio()
    );
    const entryReader::interval fraction = {0, true, 1, true};
    eliminateRoom_ = read.number(
        "eliminateRoom",
        "from which on pressure is found cell by cell [-]",
        nonNegative,
        0
    );
    eliminateFrom_ = eliminateRoom_;
    const scalar secantAngle = read.number(
        "secantAngle",
        "by which the stress may turn between two iterations [degrees]",
        {0, true, 180, true},
        45
    );
    secantCos_ = secantAngle < 180 ? std::cos(degToRad(secantAngle)) : -GREAT;
    interfaceJump_ = read.number(
        "interfaceJump",
        "of alpha at an interface [-]",
        {0, false, 1, true},
        0.2
    );
    leastRoom_ = read.number(
        "leastRoom", "part of a void that may close [-]", fraction, 0.05
    );
    emptyBelow_ = read.number(
        "emptyBelow", "alpha that carries nothing [-]", fraction, 1e-6
    );
    damageAbove_ = read.number(
        "damageAbove", "alpha above which bolus can break [-]", fraction, 0.1
    );
    voidLayers_ = read.wholeNumber(
        "voidLayers", "of cells around the bolus", {0, true, 1e6, true}, 0
    );
    subdomains_ = read.wholeNumber(
        "subdomains", "of schwarz, on each processor", {1, true, 1e4, true}, 6
    );
    const wordList axes({"x", "y", "z", "none"});
    const label axis = axes.find(read.choice(
        "subdomainAxis",
        "along which the subdomains of schwarz lie",
        axes,
        "none"
    ));
    slabs_.number = axis < 3 ? subdomains_ : 0;
    slabs_.axis = axis < 3 ? axis : 0;
    linearTolerance_ = read.number(
        "linearTolerance",
        "largest relative residual of the linear solver [-]",
        {0, false, 0.1, true},
        1e-3
    );
    monitor_ = dict.lookupOrDefault("monitor", false);
    read.has("monitor");
    read.has("linearSolver");
    read.has("petscOptions");
    read.rejectOthers();

    setContact();
    setPetsc(dict);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::coupledSystem::accept(
    surfaceScalarField& phi,
    volVectorField& wallForce,
    volScalarField& wallPower
)
{
    gather(x_);
    state_.pStart.primitiveFieldRef() = pCell_;
    if (turningLagged_)
    {
        --turnLater_;
    }
    else
    {
        turnLaterRow_ = 0;
    }
    memory_.set("turnLaterRow", turnLaterRow_);
    memory_.set("turnLater", turnLater_);

    vectorField& v = state_.pointU.primitiveFieldRef();
    space_.toPoints(q_, v);
    space_.flux(v, phi);

    // Forces of the cells on their nodes, which walls must hold; a second
    // time without the pressure on the wall faces, as in the momentum rows
    scalarField force(q_.size(), Zero);
    scalarField rowForce(q_.size(), Zero);
    scalarField pressure(mesh_.nCells());
    DynamicList<scalar> R;

    power_ = stepPower();
    elasticEnergy_.setSize(mesh_.nCells());
    const boolList held(heldNodes());
    scalar bolus = 0;
    bolusRate_ = 0;
    flowRate_ = 0;

    forAll(pCell_, c)
    {
        cellResult r;
        if (solved_[c])
        {
            evaluate(c, r);
            internalForce(c, r, R);
            const scalar rate = std::sqrt(2.0 / 3) * mag(dev(symm(r.gradU)));
            bolus += a_[c] * space_.V()[c];
            bolusRate_ += a_[c] * space_.V()[c] * rate;
            flowRate_ += a_[c] * space_.V()[c] * sqr(rate);
            bookPower(c, r, R, held);
            forAll(R, i)
            {
                const label j = space_.cellStart()[c] + i;
                const label dof = space_.cellDofs()[j];
                rowForce[dof] += R[i];
                force[dof] += R[i]
                    + r.P * (space_.V()[c] * tr(space_.G()[j]) - space_.h()[j]);
            }
        }
        else
        {
            r.P = 0;
            r.dev = Zero;
            elasticEnergy_[c] = 0;
        }
        pressure[c] = r.P;

        forAll(contactFaces_[c], fi)
        {
            const label patchi = contactPatches_[c][fi];
            const label i =
                contactFaces_[c][fi] - mesh_.boundaryMesh()[patchi].start();
            contact k;
            vector& g = elasticSlip_.boundaryFieldRef()[patchi][i];
            if (evaluateContact(c, fi, r, k))
            {
                g = k.law->retained(mag(k.slip)) * k.slip;
                bookFriction(k, mag(g));
            }
            else
            {
                g = Zero;
            }
        }

        state_.stress[c] = r.dev + r.P * symmTensor::I;

        const labelList& pts = mesh_.cellPoints()[c];
        vector U = Zero;
        for (const label p : pts) U += v[p];
        U /= pts.size();
        if (space_.wedge())
        {
            // The mean over the two sides has lost the cosine of the radius
            const vector& e2 = space_.radial();
            U += (1 / std::cos(0.5 * space_.wedgeAngle()) - 1) * (U & e2) * e2;
        }
        state_.U[c] = U;

        const bool bolus = a_[c] > 0;
        if (bolus)
        {
            state_.deviator[c] = turningLagged_ ? turned(c, r) : r.r.s;
        }
        else
        {
            state_.deviator[c] = Zero;
        }
        state_.theta[c] = bolus ? r.r.theta : 1;
        if (bolus)
        {
            const scalar strain =
                (1 - state_.D[c]) * (r.r.epsP - state_.epsilonPEq[c]);
            state_.soundStrain[c] += strain;
            const scalar q = elastoViscoPlastic::sigmaEq(r.r.s);
            if (q > SMALL && law_.damage().tension(-pCell_[c] / q))
            {
                state_.tensileStrain[c] += strain;
            }
            state_.epsilonPEq[c] = r.r.epsP;
        }
        state_.p[c] = pCell_[c];
    }
    reduce(bolus, sumOp<scalar>());
    reduce(bolusRate_, sumOp<scalar>());
    reduce(flowRate_, sumOp<scalar>());
    flowRate_ /= max(bolusRate_, VSMALL);
    bolusRate_ /= max(bolus, VSMALL);
    state_.U.correctBoundaryConditions();
    state_.p.correctBoundaryConditions();

    wallForce.primitiveFieldRef() = Zero;
    wallPower.primitiveFieldRef() = 0;
    forAll(mesh_.boundary(), patchi)
    {
        const labelList& cells = mesh_.boundary()[patchi].faceCells();
        fvPatchVectorField& F = wallForce.boundaryFieldRef()[patchi];
        fvPatchScalarField& P = wallPower.boundaryFieldRef()[patchi];
        F == vectorField(F.size(), Zero);
        P == scalarField(P.size(), Zero);

        // Power of the wall pressure: the wall sweeps the cell's volume
        if (!isA<contactWallFvPatchVectorField>(
                state_.U.boundaryField()[patchi]
            )
            || !mesh_.moving())
            continue;
        scalarField power(P.size());
        forAll(power, i)
        {
            power[i] =
                pressure[cells[i]] * mesh_.phi().boundaryField()[patchi][i];
        }
        P == power;
    }
    wallForces(force, rowForce, wallForce, wallPower);
    bookWalls(pressure, wallPower);
}


void Foam::coupledSystem::wallForces(
    const scalarField& force,
    const scalarField& rowForce,
    volVectorField& wallForce,
    volScalarField& wallPower
) const
{
    const label nd = space_.nd();
    const label nPoints = mesh_.nPoints();

    // By components of the node, at the points: force, power, and weight of
    // the faces. A fixed component goes to the faces that look that way (where
    // walls or a symmetry plane meet, each then gets its own normal force), a
    // free one to all walls by their area.
    vectorField F(nPoints, Zero);
    vectorField W(nPoints, Zero);
    vectorField weight(nPoints, Zero);
    forAll(F, p)
    {
        const label node = space_.pointNode()[p];
        for (label k = 0; k < nd; ++k)
        {
            F[p][k] = force[nd * node + k];
            W[p][k] = rowForce[nd * node + k] * space_.fixedValue(node, k);
        }
    }

    auto faceWeight = [&](const label facei, const label fp, const label k)
    {
        const label p = mesh_.faces()[facei][fp];
        const vector& a = space_.faceWeight(facei, fp);
        return k < space_.nNormals()[space_.pointNode()[p]]
            ? mag(a & space_.shape(p, k))
            : mag(a);
    };

    auto isWall = [&](const label patchi)
    {
        return isA<contactWallFvPatchVectorField>(
            state_.U.boundaryField()[patchi]
        );
    };

    auto forPoints = [&](std::function<void(label, label, label)> f)
    {
        forAll(mesh_.boundary(), patchi)
        {
            if (!isWall(patchi) && !isSymmetry(mesh_.boundaryMesh()[patchi]))
            {
                continue;
            }

            const polyPatch& pp = mesh_.boundaryMesh()[patchi];
            forAll(pp, i)
            {
                forAll(pp[i], fp) f(patchi, i, fp);
            }
        }
    };

    vectorField nodeWeight(space_.nNodes(), Zero);
    forPoints(
        [&](label patchi, label i, label fp)
        {
            const label facei = mesh_.boundaryMesh()[patchi].start() + i;
            const label p = mesh_.faces()[facei][fp];
            const label node = space_.pointNode()[p];
            for (label k = 0; k < nd; ++k)
            {
                // A symmetry plane takes nothing along itself
                if (isWall(patchi) || k < space_.nNormals()[node])
                {
                    nodeWeight[node][k] += faceWeight(facei, fp, k);
                }
            }
        }
    );
    forAll(weight, p) weight[p] = nodeWeight[space_.pointNode()[p]];

    syncTools::syncPointList(mesh_, F, plusEqOp<vector>(), vector(Zero));
    syncTools::syncPointList(mesh_, W, plusEqOp<vector>(), vector(Zero));
    syncTools::syncPointList(mesh_, weight, plusEqOp<vector>(), vector(Zero));

    forPoints(
        [&](label patchi, label i, label fp)
        {
            if (!isWall(patchi)) return;
            const label facei = mesh_.boundaryMesh()[patchi].start() + i;
            const label p = mesh_.faces()[facei][fp];
            for (label k = 0; k < nd; ++k)
            {
                if (weight[p][k] < VSMALL) continue;
                const scalar part = faceWeight(facei, fp, k) / weight[p][k];
                wallForce.boundaryFieldRef()[patchi][i] -=
                    (part * F[p][k]) * space_.basis()[space_.pointNode()[p]][k];
                wallPower.boundaryFieldRef()[patchi][i] += part * W[p][k];
            }
        }
    );
}

// ************************************************************************* //
