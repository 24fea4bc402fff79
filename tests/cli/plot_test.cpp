// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "shell.hpp"

namespace slipwave::plot_test {
namespace {

using Plot = Shell;

const std::string layers =
    "sw-layers --size 600x400 --step 10 --layer 0:1500:0:1000 --layer 100:2500:1250:2200 ";
const std::string fracture = "sw-fracture - --box 200:400,200:250 --dip 45 --friction 0.1 --viscosity 1e3 ";
const std::string shoot =
    "sw-shoot m.nc --source 300,50 --wavelet ricker:15 --receivers 0:600:20,10 --time 0.3 ";

/// m.nc, g.sgy of two components, s.nc of four snapshots, a.nc of spectra.
const std::string everything = layers + "| " + fracture + "-o m.nc; " + shoot +
                               "--record p,vz --snapshots s.nc --every 0.1 --fields p,vz -o g.sgy; "
                               "sw-spectrum g.sgy -o a.nc; ";

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Width and height of a PNG stand in its bytes 17 to 24.
std::string size_line(const std::string& file) {
  return "head -c 24 " + file + " | tail -c 8 | od --endian=big -An -t u4 | tr -s ' '";
}

}  // namespace

TEST_F(Plot, DrawsEveryKindInEveryFormatTheSameTwice) {
  done(everything);
  const std::string inputs[] = {"m.nc --survey g.sgy", "g.sgy -q --style both", "s.nc --over m.nc",
                                "a.nc --log"};
  std::string lines;
  for (const auto& input : inputs) {
    for (const std::string format : {"png", "pdf", "svg"})
      lines += "sw-plot " + input + " --size 12x9cm --dpi 60 --title 'A < B & C' -o $1/" +
               input.substr(0, 1) + "." + format + " &\n";
  }
  write("draw.sh", lines + "for job in $(jobs -p); do wait $job || exit 1; done\n");
  // Files that know the time of their making differ after a second.
  done("mkdir one two; bash draw.sh one; next_second; bash draw.sh two; diff -r one two");
  for (const auto& input : inputs) {
    const auto name = "one/" + input.substr(0, 1);
    EXPECT_EQ(content(name + ".png").substr(1, 3), "PNG");
    const auto pdf = content(name + ".pdf"), svg = content(name + ".svg");
    EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
    EXPECT_TRUE(has(pdf.substr(pdf.size() - 8), "%%EOF"));
    EXPECT_FALSE(has(pdf, "CreationDate"));
    EXPECT_TRUE(has(svg, "<title>A &lt; B &amp; C</title>"));
    done("if command -v xmllint > /dev/null; then xmllint --noout " + name + ".svg; fi");
  }
}

TEST_F(Plot, DrawsFittedGridsAtTrueDepths) {
  const auto model = [](const std::string& floor) {
    return "sw-layers -q --size 600x400 --step 10 --layer 0:1500:0:1000 --layer " + floor +
           ":2500:1250:2200 ";
  };
  done(model("sine,103,30,300") + "| " + fracture + "-o m.nc; " + shoot +
       "--snapshots s.nc --every 0.1 --fields vz,curl -q -o g.sgy");
  done("sw-plot m.nc --survey g.sgy -o m.svg; sw-plot s.nc --over m.nc --survey g.sgy -o s.svg");
  done("sw-plot m.nc --property fractures -o f.png; sw-plot s.nc --minus s.nc -o zero.png");
  const auto size = done("sw-plot s.nc --movie -o film.png; ls film-*.png | wc -l");
  EXPECT_EQ(size, "3\n");
  done(model("sine,106,30,300") + "-o other.nc; mv m.nc first.nc; cp other.nc m.nc; " + shoot +
       "--snapshots t.nc --every 0.1 --fields vz,curl -q -o h.sgy");
  expect_refused("sw-plot s.nc --minus t.nc -o no.png", 1,
                 "sw-plot: t.nc: its rows lie at other depths than those of s.nc, expected the same grid");
}

TEST_F(Plot, TakesItsInputFromAPipeAndWritesAPngToOne) {
  done(everything);
  for (const std::string file : {"m.nc", "g.sgy", "s.nc", "a.nc"}) {
    done("sw-plot -q " + file + " -o named.png; cat " + file +
         " | sw-plot -q > piped.png; test -s piped.png");
    // The command is kept in the file; the picture is the same.
    EXPECT_EQ(done(size_line("named.png")), done(size_line("piped.png"))) << file;
  }
}

TEST_F(Plot, KeepsTheCommandsThatLedToIt) {
  done(everything);
  for (const std::string input : {"m.nc", "s.nc", "a.nc"}) {
    const auto svg = done("sw-plot " + input + " -o p.svg; cat p.svg");
    EXPECT_TRUE(has(svg, input == "a.nc" ? "\nsw-spectrum\nsw-plot" : "<desc>sw-layers --size 600x400"))
        << svg.substr(0, 1000);
    EXPECT_TRUE(has(svg, "\nsw-plot " + input + "</desc>")) << svg.substr(0, 1000);
  }
  const auto svg = done("sw-plot -q g.sgy -o p.svg; cat p.svg");
  EXPECT_TRUE(has(svg, "sw-shoot --source 300,50")) << svg.substr(0, 4000);
}

TEST_F(Plot, HasTheSizeThatWasAskedFor) {
  done(everything);
  EXPECT_EQ(done("sw-plot m.nc --size 700x500px -o a.png; " + size_line("a.png")), " 700 500\n");
  EXPECT_EQ(done("sw-plot a.nc --size 10x8cm --dpi 254 -o a.png; " + size_line("a.png")), " 1000 800\n");
}

TEST_F(Plot, AMovieHasAFrameForEachTimeOnOneScale) {
  done(everything);
  done("mkdir film; sw-plot s.nc --field vz --movie -o film/wave.png");
  const auto times = done("sw-info s.nc | grep -o 'time [0-9]*' | head -n 1 | cut -d ' ' -f 2");
  EXPECT_EQ(done("ls film | wc -l"), times);
  EXPECT_TRUE(exists("film/wave-0001.png"));
  // The strongest wave sets the scale: alone, an early picture has one of its own and other bytes.
  done("sw-plot s.nc --field vz --time 0.1 -o alone.png");
  EXPECT_NE(content("alone.png"), content("film/wave-0002.png"));
  done("mkdir again; sw-plot s.nc --field vz --movie -o again/wave.png; diff -r film again");
}

TEST_F(Plot, AMovieIsMadeByFfmpegOrLeftAsPictures) {
  done(everything);
  // A program of that name that keeps what it is given: arguments, and the frames as its movie.
  const auto install = [&](const std::string& script) {
    write("ffmpeg", "#!/bin/bash\n" + script);
    done("mkdir -p bin; mv ffmpeg bin; chmod +x bin/ffmpeg");
  };
  install("printf '%s\\n' \"$@\" > arguments\nout=${@: -1}\nexec cat > \"${out#file:}\"\n");
  done("PATH=$PWD/bin:$PATH sw-plot s.nc --field vz --fps 25 --title 'a wave' --movie wave.mp4");
  done("sw-plot s.nc --field vz --title 'a wave' --movie -o frame.png");
  EXPECT_EQ(done("grep -abo IHDR wave.mp4 | wc -l"), done("ls frame-*.png | wc -l"));
  EXPECT_EQ(done("grep -x -A 1 -e -framerate arguments"), "-framerate\n25\n");
  EXPECT_EQ(done("grep -c '^title=a wave$' arguments"), "1\n");
  install("echo 'Unknown encoder libx264' >&2\nexit 1\n");
  expect_refused("PATH=$PWD/bin:$PATH sw-plot s.nc --movie no.mp4", 1,
                 "sw-plot: no.mp4: ffmpeg failed: Unknown encoder libx264");
  EXPECT_FALSE(exists("no.mp4"));
  const auto without = run("PATH=$(dirname $(command -v sw-plot)); sw-plot s.nc --movie still.gif");
  EXPECT_EQ(without.code, 0);
  const auto last = "still-000" + done("ls frame-*.png | wc -l").substr(0, 1) + ".png";
  EXPECT_EQ(without.err,
            "sw-plot: warning: ffmpeg, which makes still.gif, is not installed: wrote "
            "still-0001.png to " +
                last + " instead\n");
  EXPECT_TRUE(exists(last));
}

TEST_F(Plot, FfmpegMakesAMovieThatIsTheSameTwice) {
  if (run("command -v ffmpeg").code != 0) GTEST_SKIP() << "ffmpeg is not installed";
  done(everything);
  for (const std::string kind : {"mp4", "gif"})
    done("sw-plot s.nc --movie -o one." + kind + "; next_second; sw-plot s.nc --movie -o two." + kind +
         "; cmp one." + kind + " two." + kind);
  EXPECT_EQ(content("two.mp4").substr(4, 8), "ftypisom");
  EXPECT_EQ(content("two.gif").substr(0, 6), "GIF89a");
}

TEST_F(Plot, GathersStandTogether) {
  done(everything + "sw-filter g.sgy --gain scale:0.5 -o h.sgy");
  done("sw-plot g.sgy h.sgy --component vz --difference -o three.png");
  done("sw-plot g.sgy h.sgy --component vz --overlay -o over.pdf");
  EXPECT_GT(std::stoi(done(size_line("three.png")).substr(1)), 1500);
  done("sw-select h.sgy --where component=vz | sw-plot - g.sgy -o two.png");  // vz of both, which nobody left
                                                                              // out
  expect_refused(
      "sw-plot g.sgy m.nc --component p -o x.png", 2,
      "sw-plot: m.nc: several files can be drawn together only if all hold gathers, all spectra or "
      "all errors");
}

TEST_F(Plot, ComponentsStandTogether) {
  done(everything + "sw-plot g.sgy --component all -o all.svg; sw-plot g.sgy --component vz,p -o two.svg");
  for (const std::string name : {"all.svg", "two.svg"})
    for (const std::string word : {">vz<", ">p<", ">p (", ">vz ("})
      EXPECT_TRUE(has(content(name), word)) << name << word;
  EXPECT_LT(content("all.svg").find(">p<"), content("all.svg").find(">vz<"));  // as in the file
  EXPECT_GT(content("two.svg").find(">p<"), content("two.svg").find(">vz<"));  // as they are named
  done(
      "sw-plot g.sgy g.sgy --component p,vz --difference -o six.png; sw-plot a.nc --component vz,p -o a.svg");
  done("cat g.sgy | sw-plot - --component all -o piped.svg");
  EXPECT_TRUE(has(content("piped.svg"), ">vz<"));
}

TEST_F(Plot, NearestTracesAreInterpolatedUnlessThatIsUnwanted) {
  done(everything + "sw-plot g.sgy --component p -o a.png; sw-plot g.sgy --component p --nearest -o b.png");
  EXPECT_NE(content("a.png"), content("b.png"));
  done("sw-plot m.nc -o c.png; sw-plot m.nc --nearest -o d.png; sw-plot m.nc --interpolate -o e.png");
  const auto pixels = [&](const std::string& file) {
    return done("tail -c +$(grep -abo IDAT " + file + " | head -n 1 | cut -d : -f 1) " + file + " | cksum");
  };
  EXPECT_EQ(pixels("c.png"), pixels("d.png"));
  EXPECT_NE(pixels("c.png"), pixels("e.png"));
}

TEST_F(Plot, APlaneWaveIsNoPoint) {
  done("sw-layers --size 600x400 --step 10 --layer 0:4000:2000:2400 -o m.nc");
  const std::string wave =
      "sw-shoot m.nc --source 300,0 --wavelet ricker:15 --receivers 0:600:20,10 --time 0.2 --top absorbing ";
  write("shot.cfg", "kind = plane:10\n");
  done(wave + "--config shot.cfg -q -o plane.sgy; " + wave + "-q -o point.sgy");
  const auto reds = [&](const std::string& gather) {  // lines in the colour of sources
    done("sw-plot m.nc --survey " + gather + " -o p.svg");
    return done("grep -cE 'stroke[:=]\"?rgb\\(80%' p.svg || true");
  };
  EXPECT_NE(reds("plane.sgy"), "0\n");
  EXPECT_EQ(reds("point.sgy"), "0\n");
}

TEST_F(Plot, TakesOneFileOfSnapshotsFromAnother) {
  // Without slip all is linear, and twice the amplitude exactly twice the wave.
  const std::string linear = shoot + "--without slip --fields vz -o g.sgy --every ";
  done(layers + "| " + fracture + "-o m.nc; " + linear + "0.1 --snapshots one.nc; " + linear +
       "0.1 --amplitude 2 --snapshots two.nc; " + linear + "0.15 --snapshots late.nc");
  const auto pixels = [&](const std::string& arguments, const std::string& file) {
    done("sw-plot " + arguments + " -o " + file);
    return done("tail -c +$(grep -abo IDAT " + file + " | head -n 1 | cut -d : -f 1) " + file + " | cksum");
  };
  const auto one = pixels("one.nc", "one.png");
  EXPECT_EQ(pixels("two.nc --minus one.nc", "two.png"), one);
  EXPECT_NE(pixels("one.nc --minus one.nc", "none.png"), one);
  done("sw-plot two.nc --minus one.nc --movie -o a.png; sw-plot one.nc --movie -o b.png");
  EXPECT_EQ(done("ls a-*.png | wc -l"), done("ls b-*.png | wc -l"));
  expect_refused("sw-plot one.nc --minus m.nc -o x.png", 1,
                 "sw-plot: m.nc: found no field of time, z and x, expected snapshots in 2 dimensions");
  const auto ran = run("sw-plot one.nc --minus late.nc --time 0.1 -o x.png");
  EXPECT_TRUE(has(ran.err, "sw-plot: late.nc: has no snapshot at 0.1")) << ran.err;
  EXPECT_EQ(ran.code, 1);
  EXPECT_FALSE(exists("x.png"));
}

TEST_F(Plot, WarnsOfWhatItLeavesOut) {
  done(everything);
  const auto ran = run("sw-plot g.sgy -o g.png");
  EXPECT_EQ(ran.code, 0);
  EXPECT_EQ(ran.err,
            "sw-plot: warning: the file holds other components, too; this is p (--component chooses)\n");
  done("sw-plot g.sgy --component vz -o g.png");  // what was asked for needs no warning
}

TEST_F(Plot, SaysInALineWhatIsWrongAndLeavesNothing) {
  done(everything);
  write("notes.txt", "no picture\n");
  const auto before = files();
  const auto refused = [&](const std::string& arguments, int code, const std::string& message) {
    expect_refused("sw-plot " + arguments, code, "sw-plot: " + message);
    EXPECT_EQ(files(), before) << arguments;
  };
  refused("none.nc -o x.png", 1, "none.nc: No such file or directory");
  refused(
      "notes.txt -o x.png", 1,
      "notes.txt: is not a netCDF, SEG-Y or Seismic Unix file, expected a model, snapshots, spectra, errors "
      "or a gather");
  refused("m.nc -o x.gif", 2,
          "--output: found 'x.gif', expected a name that ends with .png, .pdf or .svg, or --movie");
  refused(
      "m.nc --map jet -o x.png", 2,
      "--map: the map 'jet' is refused: its lightness rises and falls, which draws edges that are not in the "
      "data and hides others; use viridis or uniform, for waves seismic or blue-red");
  refused("m.nc --clip 0 -o x.png", 2, "--clip: found 0, expected above 0, at most 100");
  refused("m.nc --size 5x5 -o x.png", 2,
          "--size: found '5x5', expected WIDTHxHEIGHT with cm or px behind it");
  refused("m.nc --range 5:3 -o x.png", 2, "--range: found '5:3', expected LOW:HIGH with LOW below HIGH");
  refused("m.nc --x 900:1000 -o x.png", 2, "--x: found 900:1000, the data run from 0 to 600");
  refused("g.sgy --component vx -o x.png", 2, "g.sgy: has no vx, it holds vz, p of shots 1 to 1");
  refused("g.sgy --shot 9 -o x.png", 2, "g.sgy: has no trace of shot 9, it holds vz, p of shots 1 to 1");
  refused("s.nc --field div -o x.png", 2, "s.nc: found no field 'div', it holds p, vz");
  refused("m.nc g.sgy -o x.png", 2,
          "m.nc: several files can be drawn together only if all hold gathers, all spectra or all errors");
  refused("g.sgy --component p --difference -o x.png", 2,
          "--difference: found 1 gather, expected two: FILE less FILE");
  refused("g.sgy --component p --overlay --style both -o x.png", 2,
          "--overlay draws lines only, expected --style wiggle");
  refused("g.sgy g.sgy --component p --difference --difference-gain 0 -o x.png", 2,
          "--difference-gain: found 0, expected a number other than 0");
  refused("g.sgy --component p,vx -o x.png", 2, "g.sgy: has no vx, it holds vz, p of shots 1 to 1");
  refused("g.sgy --component p,p -o x.png", 2, "--component: found p twice, expected it once");
  refused("g.sgy --component p,vz --overlay --style wiggle -o x.png", 2,
          "--overlay: found components in Pa and in m/s, expected one unit; choose a --component");
  refused("m.nc --nearest --interpolate -o x.png", 2,
          "found --interpolate and --nearest, expected one of them");
  refused("s.nc --movie x.mp4 -o y.mp4", 2, "--movie: found x.mp4 and -o y.mp4, expected one of them");
  refused("s.nc -o x.mp4", 2,
          "--output: found 'x.mp4', expected a name that ends with .png, .pdf or .svg, or --movie");
  refused("s.nc --movie x.mp4 --fps 0", 2, "--fps: found 0, expected 0.1 to 240");
  refused("m.nc --movie -o x.png", 2, "m.nc: --movie does not apply to this kind of file");
  refused("s.nc --movie", 2,
          "--movie: draws one file of snapshots, and needs a name (-o NAME.mp4 or NAME.png)");
}

TEST_F(Plot, DrawsTheRockAtAPoint) {
  done(
      "sw-layers -q --size 600x400 --step 10 --layer 0:1500:0:1000 --layer '100:2500:1250:2200 qp=60 qs=30' "
      "-o m.nc; "
      "sw-plot m.nc --at 305,55 -o water.svg; sw-plot m.nc --at 305,155 --q-frequency 20 -o rock.svg");
  EXPECT_GT(content("rock.svg").size(), content("water.svg").size());
  const auto asked = run("sw-plot m.nc --at 305,155 -o x.svg");
  EXPECT_EQ(asked.code, 2);
  EXPECT_TRUE(has(asked.err, "attenuates, expected --q-frequency F, at which it has the model's speeds, Hz"))
      << asked.err;
  done(
      "test ! -e x.svg; sw-layers -q --size 100x100x100 --step 10 --layer 0:2500:1250:2200 -o cube.nc; "
      "sw-plot cube.nc --at 50,50,50 -o cube.svg");
}

TEST_F(Plot, ADamagedFileLeavesAnOlderPictureAsItWas) {
  done(everything + "sw-plot m.nc -o m.png; cp m.png old.png; head -c 3000 m.nc > cut.nc");
  const auto ran = run("sw-plot cut.nc -o m.png");
  EXPECT_EQ(ran.code, 1);
  EXPECT_TRUE(has(ran.err, "sw-plot: cut.nc: ")) << ran.err;
  done("cmp m.png old.png");
}

}  // namespace slipwave::plot_test
