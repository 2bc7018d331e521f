// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers

#include "lumenMotionSolver.H"
#include "DynamicList.H"
#include "closedPoints.H"
#include "addToRunTimeSelectionTable.H"
#include "entryReader.H"
#include "emptyPolyPatch.H"
#include "polyMesh.H"
#include "primitiveMeshTools.H"

#include <algorithm>

// * * * * * * * * * * * * * * Static Data Members * * * * * * * * * * * * * //

namespace Foam
{
defineTypeNameAndDebug(lumenMotionSolver, 0);

addToRunTimeSelectionTable(motionSolver, lumenMotionSolver, dictionary);
}


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

void Foam::lumenMotionSolver::checkDimensions() const
{
    label nEmptyFaces = 0;

    for (const polyPatch& pp : mesh().boundaryMesh())
    {
        if (isA<emptyPolyPatch>(pp))
        {
            nEmptyFaces += pp.size();
        }
    }

    if (returnReduce(nEmptyFaces, sumOp<label>()))
    {
        FatalIOErrorInFunction(coeffDict())
            << "Entry 'motionSolver' is " << typeName
            << ", which moves points radially, but the mesh is planar (it has"
            << " patches of type empty); valid are a wedge or a"
            << " three-dimensional mesh" << exit(FatalIOError);
    }
}


void Foam::lumenMotionSolver::checkCells(const label nSamples) const
{
    if (nSamples == 0)
    {
        return;
    }

    const scalar tStart = time().value();
    const scalar tEnd = max(tStart, time().endTime().value());

    DynamicList<scalar> times;

    for (label i = 0; i <= nSamples; ++i)
    {
        times.append(tStart + (tEnd - tStart) * i / nSamples);
    }

    for (const scalar t : motion_->wall().eventTimes())
    {
        if (t > tStart && t < tEnd)
        {
            times.append(t);
        }
    }

    scalar smallest = GREAT;
    scalar smallestTime = tStart;

    scalarField ownVolume;
    scalarField neiVolume;

    for (const scalar t : times)
    {
        const pointField p(points(t));

        // The mean of its points is inside a convex cell: good enough an apex
        // for pyramids that only have to be positive
        pointField centres(mesh().nCells(), Zero);

        forAll(centres, celli)
        {
            const labelList& cellPoints = mesh().cellPoints(celli);

            for (const label pointi : cellPoints)
            {
                centres[celli] += p[pointi];
            }
            centres[celli] /= cellPoints.size();
        }

        primitiveMeshTools::facePyramidVolume(
            mesh(), p, centres, ownVolume, neiVolume
        );

        const scalar volume = min(gMin(ownVolume), gMin(neiVolume));

        if (volume < smallest)
        {
            smallest = volume;
            smallestTime = t;
        }
    }

    if (!(smallest > 0))
    {
        FatalIOErrorInFunction(coeffDict())
            << "The motility inverts cells: the smallest face pyramid has "
            << smallest << " m3 at t = " << smallestTime
            << " s; every pyramid must be greater than 0. Check the waves and"
            << " the sphincter in constant/motilityProperties and the mesh"
            << exit(FatalIOError);
    }

    Info << typeName << ": no cell is inverted at " << times.size()
         << " times from " << tStart << " s to " << tEnd
         << " s; smallest face pyramid " << smallest
         << " m3 at t = " << smallestTime << " s" << nl << endl;
}


Foam::tmp<Foam::pointField> Foam::lumenMotionSolver::points(
    const scalar t
) const
{
    tmp<pointField> tp(new pointField(points0()));

    // As lumenMotion::displacement, with the radii of the stations
    const scalarList& r = radii(t);
    pointField& p = tp.ref();
    forAll(p, i)
    {
        const label s = station_[i];
        p[i] += (r[s] / referenceRadius_[s] - 1) * motion_->radial(p[i]);
    }

    return tp;
}


void Foam::lumenMotionSolver::setStations()
{
    scalarList x(points0().size());
    forAll(x, i) x[i] = motion_->axial(points0()[i]);

    x_ = x;
    sort(x_);
    x_.resize(label(std::unique(x_.begin(), x_.end()) - x_.begin()));

    station_.resize(x.size());
    forAll(x, i)
    {
        station_[i] =
            label(std::lower_bound(x_.begin(), x_.end(), x[i]) - x_.begin());
    }

    referenceRadius_.resize(x_.size());
    forAll(x_, s)
    {
        referenceRadius_[s] =
            motion_->wall().radius(x_[s], motion_->referenceTime());
    }
}


const Foam::scalarList& Foam::lumenMotionSolver::radii(const scalar t) const
{
    for (const auto& known : radii_)
    {
        if (known.first() == t && known.second().size() == x_.size())
        {
            return known.second();
        }
    }

    // In the place of the older one
    Swap(radii_[0], radii_[1]);
    radii_[1].first() = t;
    scalarList& r = radii_[1].second();
    r.resize(x_.size());
    forAll(x_, s) r[s] = motion_->wall().radius(x_[s], t);

    return r;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::lumenMotionSolver::lumenMotionSolver(
    const polyMesh& mesh,
    const IOdictionary& dict
) :
    points0MotionSolver(mesh, dict, typeName),
    motion_(lumenMotion::New(mesh.time())),
    closedPoints_(IOobject(closedPoints::name, mesh.time().timeName(), mesh)),
    radii_(Tuple2<scalar, scalarList>(GREAT, scalarList()))
{
    setStations();

    // Not coeffDict(), which is all of dynamicMeshDict if there is none
    const word coeffsName(typeName + "Coeffs");

    entryReader read(
        dict.found(coeffsName)
            ? entryReader::subDictionary(
                  dict, coeffsName, "checkSamples, wallTolerance"
              )
            : dictionary::null
    );
    const scalar tolerance = read.number(
        "wallTolerance",
        "of points on the wall, in parts of its radius [-]",
        entryReader::positive,
        1e-5
    );
    const label nSamples = read.wholeNumber(
        "checkSamples",
        "times at which the cells are checked",
        {0, true, 999999, true},
        200
    );
    read.rejectOthers();

    checkDimensions();

    motion_->checkCovers(points0());

    motion_->checkAxis(mesh, points0(), tolerance);
    motion_->checkWall(points0(), tolerance);

    scalar xEnd = -GREAT;
    for (const point& p : points0())
    {
        xEnd = max(xEnd, motion_->axial(p));
    }

    motion_->wall().writeTimeline(Info, returnReduce(xEnd, maxOp<scalar>()));

    checkCells(nSamples);
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::pointField> Foam::lumenMotionSolver::curPoints() const
{
    return points(time().value());
}


void Foam::lumenMotionSolver::solve()
{
    DynamicList<label> closed;

    // In the step that closes it, the lumen still empties
    const scalar t = time().value();
    const scalar tOld = t - time().deltaTValue();

    boolList shut(x_.size());
    const scalarList before(radii(tOld));
    const scalarList& now = radii(t);
    forAll(shut, s)
    {
        shut[s] =
            motion_->wall().closed(before[s]) && motion_->wall().closed(now[s]);
    }
    forAll(station_, pointi)
    {
        if (shut[station_[pointi]]) closed.append(pointi);
    }

    closedPoints_.transfer(closed);
}


// ************************************************************************* //
