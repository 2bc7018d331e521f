// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "rigidToolMotionSolver.H"
#include "addToRunTimeSelectionTable.H"
#include "polyMesh.H"
#include "primitiveMeshTools.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "volFields.H"

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(rigidToolMotionSolver, 0);

const word rigidToolMotionSolver::travelName("toolTravel");

addToRunTimeSelectionTable(motionSolver, rigidToolMotionSolver, dictionary);
}


// * * * * * * * * * * * * * Local Helper Functions  * * * * * * * * * * * * //

namespace
{

// Largest distance of two corners of a face across an axis
Foam::scalar width(
    const Foam::face& f,
    const Foam::pointField& p,
    const Foam::vector& axis
)
{
    Foam::scalar largest = 0;
    forAll(f, i)
    {
        for (Foam::label j = 0; j < i; ++j)
        {
            const Foam::vector r(p[f[i]] - p[f[j]]);
            largest = Foam::max(largest, Foam::mag(r - (r & axis) * axis));
        }
    }
    return largest;
}

} // End anonymous namespace


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

Foam::label Foam::rigidToolMotionSolver::readPatch()
{
    const word name(read_.name("patch", "of the tool's surface"));
    const label patchi = mesh().boundaryMesh().findPatchID(name);

    if (patchi < 0)
    {
        read_.refuse(
            "patch",
            "no patch has this name; valid are "
                + entryReader::list(mesh().boundaryMesh().names())
        );
    }
    if (returnReduce(mesh().boundaryMesh()[patchi].size(), sumOp<label>()) == 0)
    {
        read_.refuse(
            "patch", "it has no faces; valid is the patch of the tool's surface"
        );
    }

    return patchi;
}


void Foam::rigidToolMotionSolver::setExtents()
{
    yMin_ = back_ = GREAT;
    yMax_ = front_ = -GREAT;

    for (const point& p : points0())
    {
        yMin_ = min(yMin_, p & d_);
        yMax_ = max(yMax_, p & d_);
    }

    for (const label pointi : mesh().boundaryMesh()[patch_].meshPoints())
    {
        back_ = min(back_, points0()[pointi] & d_);
        front_ = max(front_, points0()[pointi] & d_);
    }

    reduce(yMin_, minOp<scalar>());
    reduce(yMax_, maxOp<scalar>());
    reduce(back_, minOp<scalar>());
    reduce(front_, maxOp<scalar>());

    const Tuple2<scalar, scalar> margins(
        read_.pair("rigidZone", "(ahead behind) [m]")
    );

    if (!(margins.first() > 0) || !(margins.second() > 0))
    {
        read_.refuse(
            "rigidZone",
            "valid are two lengths > 0 m: ahead of the tool and behind it"
        );
    }

    zoneMax_ = front_ + margins.first();
    zoneMin_ = back_ - margins.second();
}


void Foam::rigidToolMotionSolver::checkWay(
    const scalar least,
    const scalar most
) const
{
    const scalar ahead = yMax_ - zoneMax_;
    const scalar behind = zoneMin_ - yMin_;

    if (!(most < ahead) || !(-least < behind))
    {
        FatalIOErrorInFunction(read_.dict())
            << "Entry '" << (read_.dict().found("speed") ? "speed" : "history")
            << "': the tool leaves the mesh: its travel between "
            << time().value() << " s and " << time().endTime().value()
            << " s goes from " << least << " m to " << most
            << " m; valid are travels from > " << -behind << " m to < " << ahead
            << " m, where the tool's rigidZone reaches the ends of the mesh"
            << exit(FatalIOError);
    }
}


void Foam::rigidToolMotionSolver::checkThickness() const
{
    const polyPatch& pp = mesh().boundaryMesh()[patch_];

    vector across(axis_ ^ d_);
    if (mag(across) < SMALL)
    {
        FatalIOErrorInFunction(read_.dict())
            << "Entry 'axis' is " << axis_ << ", along the direction " << d_
            << "; valid is a tool whose long axis is across its way"
            << exit(FatalIOError);
    }
    across /= mag(across);

    scalar low = GREAT;
    scalar high = -GREAT;
    for (const label pointi : pp.meshPoints())
    {
        low = min(low, points0()[pointi] & across);
        high = max(high, points0()[pointi] & across);
    }
    reduce(low, minOp<scalar>());
    reduce(high, maxOp<scalar>());

    scalar sum = 0;
    for (const face& f : pp)
    {
        sum += width(f, points0(), axis_);
    }
    const scalar size = returnReduce(sum, sumOp<scalar>())
        / returnReduce(pp.size(), sumOp<label>());

    // The other half of a tool that is cut by a plane of symmetry
    scalar thickness = high - low;
    for (const polyPatch& other : mesh().boundaryMesh())
    {
        if (!isA<symmetryPlanePolyPatch>(other)
            && !isA<symmetryPolyPatch>(other))
        {
            continue;
        }

        scalar position = -GREAT;
        for (const label pointi : other.meshPoints())
        {
            position = points0()[pointi] & across;
            break;
        }
        scalar along = 0;
        if (other.size())
        {
            along = mag(other.faceNormals()[0] & across);
        }
        reduce(position, maxOp<scalar>());
        reduce(along, maxOp<scalar>());

        if (along > 0.9
            && min(mag(position - low), mag(position - high))
                < 1e-3 * (high - low))
        {
            thickness *= 2;
        }
    }

    if (!(thickness >= 3 * size))
    {
        FatalIOErrorInFunction(read_.dict())
            << "Entry 'patch' is " << pp.name() << ", a tool of " << thickness
            << " m across its way, which is " << thickness / size
            << " cells of its surface (" << size << " m); valid are tools of"
            << " at least 3 cells" << exit(FatalIOError);
    }
}


void Foam::rigidToolMotionSolver::checkCells(const scalar travel) const
{
    const pointField p(points(travel));

    // The mean of its points is inside a convex cell: good enough an apex for
    // pyramids that only have to be positive
    pointField centres(mesh().nCells(), Zero);

    forAll(centres, celli)
    {
        const labelList& cellPoints = mesh().cellPoints()[celli];

        for (const label pointi : cellPoints)
        {
            centres[celli] += p[pointi];
        }
        centres[celli] /= cellPoints.size();
    }

    scalarField ownVolume;
    scalarField neiVolume;

    primitiveMeshTools::facePyramidVolume(
        mesh(), p, centres, ownVolume, neiVolume
    );

    const scalar smallest = min(gMin(ownVolume), gMin(neiVolume));

    if (!(smallest > 0))
    {
        FatalIOErrorInFunction(read_.dict())
            << "Entry 'rigidZone': the motion inverts cells: after a travel of "
            << travel << " m the smallest face pyramid has " << smallest
            << " m3; valid is a mesh whose pyramids stay greater than 0"
            << exit(FatalIOError);
    }
}


void Foam::rigidToolMotionSolver::checkOutside() const
{
    if (!mesh().foundObject<volScalarField>("alpha"))
    {
        return;
    }

    const polyPatch& pp = mesh().boundaryMesh()[patch_];
    const volScalarField& alpha = mesh().lookupObject<volScalarField>("alpha");

    scalar fullest = 0;
    forAll(pp, i)
    {
        const scalar depth = front_ - (pp[i].centre(points0()) & d_);

        if (depth > width(pp[i], points0(), axis_))
        {
            fullest = max(fullest, alpha[pp.faceCells()[i]]);
        }
    }
    reduce(fullest, maxOp<scalar>());

    if (fullest > 0.5)
    {
        FatalIOErrorInFunction(read_.dict())
            << "Entry 'embedded' is no, but the tool " << pp.name()
            << " starts inside the bolus: a cell at its side has alpha "
            << fullest << "; valid are alpha <= 0.5 everywhere but at the"
            << " tool's front, or embedded yes" << exit(FatalIOError);
    }
}


Foam::tmp<Foam::pointField> Foam::rigidToolMotionSolver::points(
    const scalar travel
) const
{
    tmp<pointField> tp(new pointField(points0()));

    for (point& p : tp.ref())
    {
        const scalar y = p & d_;
        const scalar w = y > zoneMax_ ? (yMax_ - y) / (yMax_ - zoneMax_)
            : y < zoneMin_            ? (y - yMin_) / (zoneMin_ - yMin_)
                                      : 1;
        p += (w * travel) * d_;
    }

    return tp;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::rigidToolMotionSolver::rigidToolMotionSolver(
    const polyMesh& mesh,
    const IOdictionary& dict
) :
    points0MotionSolver(mesh, dict, typeName),
    read_(entryReader::subDictionary(dict, typeName + "Coeffs", "of the tool")),
    patch_(readPatch()),
    d_(read_.direction("direction", "of the way")),
    axis_(read_.direction("axis", "of the tool", vector(0, 0, 1))),
    history_(
        read_,
        mesh.time().value(),
        max(mesh.time().value(), mesh.time().endTime().value())
    ),
    embedded_(read_.flag("embedded", "does it start in the bolus?", false)),
    // A run that goes on has the tool where it belongs
    unchecked_(!embedded_ && history_.travel(mesh.time().value()) == 0),
    travel_(
        IOobject(
            travelName,
            mesh.time().timeName(),
            mesh,
            IOobject::NO_READ,
            IOobject::NO_WRITE
        ),
        dimensionedScalar(
            travelName,
            dimLength,
            history_.travel(mesh.time().value())
        )
    )
{
    setExtents();
    read_.rejectOthers();

    scalar least, most;
    history_.extremes(
        mesh.time().value(),
        max(mesh.time().value(), mesh.time().endTime().value()),
        least,
        most
    );

    checkThickness();
    checkWay(least, most);
    checkCells(least);
    checkCells(most);

    Info << typeName << ": travel from " << least << " m to " << most
         << " m; no cell is inverted; those ahead end with "
         << 1 - most / (yMax_ - zoneMax_) << " of their length, those behind "
         << 1 + most / (zoneMin_ - yMin_) << nl << endl;
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::rigidToolMotionSolver::curPoints() const
{
    return points(history_.travel(time().value()));
}


void Foam::rigidToolMotionSolver::solve()
{
    if (unchecked_)
    {
        checkOutside();
        unchecked_ = false;
    }

    travel_.value() = history_.travel(time().value());
}


// ************************************************************************* //
