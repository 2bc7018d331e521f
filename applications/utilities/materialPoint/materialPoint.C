// SPDX-License-Identifier: GPL-3.0-or-later
// Copyright (C) 2026 the bolusFoam developers
/*---------------------------------------------------------------------------*\
Application
    materialPoint

Description
    A one-cell rheometer: takes the bolus properties of any case through a
    programme of loading segments and writes stress and strain as a table. It
    needs neither a mesh nor a case. The material, its time integration and
    the tangent are those of the solver.

Usage
    materialPoint [-dict FILE] [-out FILE]

    - \par -dict FILE
      The dictionary, default system/materialPointDict

    - \par -out FILE
      The table, default the standard output

    \table
        Property           | Description                    | Required | Default
        bolusProperties    | the material, see elastoViscoPlastic    | yes |
        segments           | the programme, see loadingSegment       | yes |
        maxStrainIncrement | largest step of a strain [-]            | no | 1e-5
        rows               | rows of the table for each segment      | no | 100
        openingViscosity   | see materialSpecimen [Pa s]             | no | 100
        libs               | libraries of laws of your own           | no | none
        checkTangent       | yes: compare the consistent tangent with finite \
                             differences at each row, and fail beyond a \
                             relative difference of 1e-6             | no | no
    \endtable

    \verbatim
    bolusProperties
    {
        #include "bolusProperties"
    }

    segments
    {
        compression
        {
            mode        uniaxial;
            rate        0.1;
            strain      -1;
        }
        relaxation
        {
            mode        uniaxial;
            duration    600;
        }
    }
    \endverbatim

    Columns: logarithmic strains and the shear strain gamma; the equivalent
    strain sqrt(axial^2 + gamma^2/3), as a rheologist converts it; Cauchy
    stresses, tension > 0; p, compression > 0. D is 1 from the row on at
    whose time damage began; the stress of that row is still the intact one.

\*---------------------------------------------------------------------------*/

#include "Fstream.H"
#include "argList.H"
#include "dlLibraryTable.H"
#include "entryReader.H"
#include "loadingSegment.H"
#include "materialSpecimen.H"

#include <fstream>
#include <iomanip>
#include <iostream>

using namespace Foam;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace
{

dictionary readDictionary(const fileName& path)
{
    IFstream file(path);

    if (!file.good())
    {
        FatalErrorInFunction << "Cannot read the dictionary " << path
                             << "; give another with -dict FILE"
                             << exit(FatalError);
    }

    return dictionary(file);
}


const char* const columns[] = {
    "time[s]",
    "axialStrain[-]",
    "lateralStrain[-]",
    "shearStrain[-]",
    "epsilonEq[-]",
    "axialStress[Pa]",
    "lateralStress[Pa]",
    "shearStress[Pa]",
    "sigmaEq[Pa]",
    "epsilonPEq[-]",
    "p[Pa]",
    "triaxiality[-]",
    "D[-]"
};


void writeRow(std::ostream& os, const materialSpecimen::state& at)
{
    const symmTensor stress(at.stress());

    const scalar values[] = {
        at.t,
        at.strain.xx(),
        at.strain.yy(),
        at.strain.yx(),
        std::sqrt(sqr(at.strain.xx()) + sqr(at.strain.yx()) / 3),
        stress.xx(),
        stress.yy(),
        stress.xy(),
        elastoViscoPlastic::sigmaEq(at.s),
        at.epsP,
        at.p,
        at.triaxiality(),
        scalar(at.damaged)
    };

    for (const scalar value : values)
    {
        os << std::setw(20) << value;
    }
    os << '\n';
}

} // End anonymous namespace

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

int main(int argc, char* argv[])
{
    argList::addNote(
        "One-cell rheometer: a table of stress and strain of the bolus "
        "material in a programme of loading segments"
    );
    argList::noBanner();
    argList::noParallel();
    argList::noFunctionObjects();
    argList::removeOption("case");
    argList::addOption(
        "dict", "file", "Read another dictionary than system/materialPointDict"
    );
    argList::addOption("out", "file", "Write the table to this file");

    const argList args(argc, argv);

    const dictionary dict = readDictionary(
        args.found("dict") ? fileName(args["dict"])
                           : fileName("system/materialPointDict")
    );

    entryReader read(dict);

    read.require("bolusProperties", "the material");
    read.require("segments", "the loading programme");

    const scalar maxStrainIncrement = read.number(
        "maxStrainIncrement",
        "largest step of a strain [-]",
        {0, false, 0.1, true},
        1e-5
    );
    const scalar rows = read.number(
        "rows", "rows of the table for each segment", {1, true, 1e6, true}, 100
    );
    const scalar openingViscosity = read.number(
        "openingViscosity",
        "viscosity of the opening of damaged material [Pa s]",
        entryReader::positive,
        100
    );
    const bool checkTangent = read.choice(
                                  "checkTangent",
                                  "compare the tangent with finite differences",
                                  wordList({"no", "yes"}),
                                  "no"
                              )
        == "yes";

    // Before the specimen, whose law may be in one of them
    dlLibraryTable libraries;
    if (read.has("libs") && !libraries.open(dict, "libs"))
    {
        FatalIOErrorInFunction(dict)
            << "Entry libs: not all of " << dict.get<fileNameList>("libs")
            << " can be loaded; valid are libraries by their path, or those "
            << "on LD_LIBRARY_PATH" << exit(FatalIOError);
    }

    read.rejectOthers();

    materialSpecimen specimen(
        entryReader::subDictionary(dict, "bolusProperties", "the material"),
        openingViscosity
    );

    const dictionary& programme =
        entryReader::subDictionary(dict, "segments", "the loading programme");

    PtrList<loadingSegment> segments;
    for (const entry& e : programme)
    {
        segments.append(new loadingSegment(
            entryReader::subDictionary(
                programme, e.keyword(), "a loading segment"
            )
        ));
    }

    if (segments.empty())
    {
        FatalIOErrorInFunction(programme)
            << "Entry segments is empty; valid is at least one loading "
            << "segment, NAME { mode uniaxial; rate ...; strain ...; }"
            << exit(FatalIOError);
    }

    std::ofstream file;
    if (args.found("out"))
    {
        file.open(args["out"]);
        if (!file)
        {
            FatalErrorInFunction << "Cannot write the table " << args["out"]
                                 << "; give another file with -out FILE"
                                 << exit(FatalError);
        }
    }
    std::ostream& os = args.found("out") ? file : std::cout;
    os << std::setprecision(12);

    os << '#';
    for (const char* column : columns)
    {
        os << ' ' << std::setw(19) << column;
    }
    os << '\n';
    writeRow(os, specimen.now());

    materialSpecimen::comparison tangent = {0, 0};

    for (const loadingSegment& segment : segments)
    {
        os << "# segment " << segment.name() << '\n';

        label row = 0;

        segment.apply(
            specimen,
            maxStrainIncrement,
            [&](const scalar dt, const scalar done)
            {
                // Rows are equally spaced, those of a hold with the cube
                // root of time, as relaxation is fast first
                const scalar progress =
                    segment.isHold() ? std::cbrt(done) : done;

                if (progress * rows < row + 1 - 1e-9)
                {
                    return;
                }

                row = label(progress * rows + 1e-9);
                writeRow(os, specimen.now());

                if (checkTangent)
                {
                    const materialSpecimen::comparison here =
                        specimen.compareTangent(dt);
                    tangent.error = max(tangent.error, here.error);
                    tangent.directions += here.directions;
                }
            }
        );
    }

    if (checkTangent)
    {
        os << "# tangent differs from finite differences by " << tangent.error
           << " in " << tangent.directions << " directions\n";

        if (!(tangent.error < 1e-6) || tangent.directions == 0)
        {
            FatalErrorInFunction
                << "The consistent tangent differs from finite differences by "
                << tangent.error << " in " << tangent.directions
                << " directions; valid is less than 1e-6 in more than 0"
                << exit(FatalError);
        }
    }

    os.flush();
    if (!os)
    {
        FatalErrorInFunction << "Cannot write the table to the end"
                             << exit(FatalError);
    }

    return 0;
}


// ************************************************************************* //
