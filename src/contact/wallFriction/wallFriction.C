// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "wallFriction.H"
#include "contactPatches.H"
#include "contactWallFvPatchVectorField.H"
#include "frictionless.H"
#include "volFields.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

bool Foam::wallFriction::evaluate(
    const label c,
    const label fi,
    const bolus& b,
    const scalarField& q,
    contact& k
) const
{
    // Bolus rubs, on its part of the face
    if (b.alpha == 0) return false;

    const label facei = faces_[c][fi];
    const label patchi = patches_[c][fi];
    const fvMesh& mesh = space_.mesh();
    const face& f = mesh.faces()[facei];

    k.n = Zero;
    forAll(f, fp) k.n += space_.faceWeight(facei, fp);
    if (space_.nd() == 2) k.n -= (k.n & space_.normal()) * space_.normal();
    k.n /= mag(k.n);

    k.pn = lagged_ ? state_.p[c] - (k.n & state_.deviator[c] & k.n)
                   : b.p - (k.n & b.s & k.n);
    if (k.pn <= 0) return false;

    k.law = laws_[patchi];
    k.weight.setSize(f.size());
    k.area = 0;
    vector v = Zero;
    forAll(f, fp)
    {
        const label node = space_.pointNode()[f[fp]];
        k.weight[fp] = mag(space_.faceWeight(facei, fp));
        k.area += k.weight[fp];
        for (label i = space_.nFixed()[node]; i < space_.nd(); ++i)
        {
            const label dof = space_.nd() * node + i;
            v += k.weight[fp] * (q[dof] - space_.fixedValue(node, i))
                * space_.basis()[node][i];
        }
    }
    v -= (v & k.n) * k.n;

    // What the contact remembers, turned with the wall
    const label i = facei - mesh.boundaryMesh()[patchi].start();
    vector g = state_.elasticSlip.boundaryField()[patchi][i];
    const scalar magG = mag(g);
    g -= (g & k.n) * k.n;
    if (mag(g) > VSMALL) g *= magG / mag(g);

    k.step = (deltaT_ / k.area) * v;
    k.slip = g + k.step;
    return true;
}


Foam::scalar Foam::wallFriction::change(
    const label c,
    const label fi,
    const contact& k,
    const scalarField& q,
    const scalarField& qOther
) const
{
    const face& f = space_.mesh().faces()[faces_[c][fi]];
    vector v = Zero;
    forAll(f, fp)
    {
        const label node = space_.pointNode()[f[fp]];
        for (label i = space_.nFixed()[node]; i < space_.nd(); ++i)
        {
            const label dof = space_.nd() * node + i;
            v +=
                k.weight[fp] * (qOther[dof] - q[dof]) * space_.basis()[node][i];
        }
    }
    return deltaT_ / k.area * mag(v);
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::wallFriction::wallFriction(const nodalSpace& space, bolusState& state) :
    space_(space),
    state_(state),
    laws_(space.mesh().boundaryMesh().size(), nullptr),
    faces_(space.mesh().nCells()),
    patches_(space.mesh().nCells()),
    rubs_(false),
    lagged_(false),
    deltaT_(1)
{
    const polyBoundaryMesh& bm = space.mesh().boundaryMesh();
    forAll(bm, patchi)
    {
        if (!contactPatches::isWall(state.U, patchi)) continue;
        const frictionLaw& law = refCast<const contactWallFvPatchVectorField>(
            state.U.boundaryField()[patchi]
        )
                                     .friction();
        if (law.sticks()) continue;

        laws_[patchi] = &law;
        if (!isA<frictionless>(law)) rubs_ = true;
        const labelList& cells = bm[patchi].faceCells();
        forAll(cells, i)
        {
            faces_[cells[i]].append(bm[patchi].start() + i);
            patches_[cells[i]].append(patchi);
        }
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::wallFriction::add(
    const label c,
    const bolus& b,
    const scalarField& q,
    const scalarField* qLast,
    const UList<symmTensor>& dS,
    UList<scalar>& R,
    scalarField* J
) const
{
    const label n = R.size() - 1;
    const label nd = space_.nd();
    forAll(faces_[c], fi)
    {
        contact k;
        if (!evaluate(c, fi, b, q, k)) continue;

        const face& f = space_.mesh().faces()[faces_[c][fi]];
        const scalar slip = mag(k.slip);

        scalar factor, dpn, dslip;
        k.law->factor(k.pn, slip, factor, dpn, dslip);
        if (lagged_) dpn = 0;

        // The tangent is for faces that have found their slip, and for those
        // that begin to slip
        if (qLast && J && change(c, fi, k, q, *qLast) > 0.3 * slip) dslip = 0;

        forAll(f, fp)
        {
            const label node = space_.pointNode()[f[fp]];
            const label s = space_.slot(c, node);
            for (label i = space_.nFixed()[node]; i < nd; ++i)
            {
                const scalar w = b.alpha * k.weight[fp];
                const scalar along = k.slip & space_.basis()[node][i];
                R[s + i] += w * factor * along;
                if (!J) continue;

                scalar* row = &(*J)[(s + i) * (n + 1)];
                forAll(f, gp)
                {
                    const label other = space_.pointNode()[f[gp]];
                    const label t = space_.slot(c, other);
                    for (label j = space_.nFixed()[other]; j < nd; ++j)
                    {
                        vector d = space_.basis()[other][j];
                        d = (deltaT_ * k.weight[gp] / k.area)
                            * (d - (d & k.n) * k.n);
                        row[t + j] += w
                            * (factor * (d & space_.basis()[node][i])
                                + dslip * along * (k.slip & d)
                                    / max(slip, VSMALL));
                    }
                }
                if (dpn == 0) continue;
                for (label j = 0; j <= n; ++j)
                {
                    row[j] += w * dpn * along
                        * ((j == n ? 1 : 0) - (k.n & dS[j] & k.n));
                }
            }
        }
    }
}


void Foam::wallFriction::forget(const label c)
{
    forAll(faces_[c], fi)
    {
        const label patchi = patches_[c][fi];
        state_.elasticSlip.boundaryFieldRef()
            [patchi]
            [faces_[c][fi] - space_.mesh().boundaryMesh()[patchi].start()] =
            Zero;
    }
}


void Foam::wallFriction::accept(
    const label c,
    const bolus& b,
    const scalarField& q,
    powerLedger& ledger,
    scalar& slipEnergy
)
{
    forAll(faces_[c], fi)
    {
        const label patchi = patches_[c][fi];
        const label i =
            faces_[c][fi] - space_.mesh().boundaryMesh()[patchi].start();
        vector& g = state_.elasticSlip.boundaryFieldRef()[patchi][i];
        contact k;
        if (!evaluate(c, fi, b, q, k))
        {
            g = Zero;
            continue;
        }
        g = k.law->retained(mag(k.slip)) * k.slip;

        const scalar area = b.alpha * k.area;
        scalar factor, dpn, dslip;
        k.law->factor(k.pn, mag(k.slip), factor, dpn, dslip);
        ledger["friction"] += area * factor * (k.slip & k.step) / deltaT_;
        k.law->factor(k.pn, mag(g), factor, dpn, dslip);
        slipEnergy += 0.5 * area * factor * sqr(mag(g));
    }
}

// ************************************************************************* //
