// SPDX-License-Identifier: BSD-3-Clause
#include "fault_scene.hpp"

void FaultScene::SetUp() {
  done(
      "mkdir in; sw-layers --size 300x200 --step 10 --layer 0:2000:1000:2000 --layer 100:3000:1600:2300 -o "
      "in/m.nc; "
      "sw-shoot in/m.nc --source 150,10 --receivers 0:300:50,10 --wavelet ricker:10 --time 0.1 --record "
      "vx,vz "
      "--every 0.05 --snapshots in/s.nc -o in/a.sgy; sw-export in/m.nc --property vp -o in/vp.sgy");
}

std::vector<FaultScene::Command> FaultScene::commands() {
  const std::string shot =
      " in/m.nc --source 150,10 --receivers 0:300:50,10 --wavelet ricker:10 --time 0.1 --record vx,vz";
  return {
      {"sw-layers", "--size 300x200 --step 5 --layer 0:2000:1000:2000 -o {}", "out.nc"},
      {"sw-marmousi", "--size 300x200 --step 10 --water 50 -o {}", "out.nc"},
      {"sw-import", "--vp in/m.nc --vs in/m.nc --rho in/m.nc -o {}", "out.nc"},
      {"sw-import", "--vp in/vp.sgy --step 10 --vs-from-vp castagna --rho-from-vp gardner -o {}", "out.nc"},
      {"sw-fracture", "in/m.nc --box 100:200,120:150 --dip 45 --friction 0.1 --viscosity 1 -o {}", "out.nc"},
      {"sw-shoot", shot + " -o {}", "out.sgy"},
      {"sw-shoot", shot + " -o /dev/null --every 0.02 --snapshots {}", "out.nc"},
      {"sw-accuracy", shot + " --steps 10 --orders 1 --cfls 0.9 --reference 3,0.5,10 -o {} > /dev/null",
       "out.nc"},
      {"sw-export", "in/m.nc --property vp -o {}", "out.sgy"},
      {"sw-export", "in/s.nc --property vz -o {}", "out.sgy"},
      {"sw-select", "in/a.sgy --where component=vz -o {}", "out.sgy"},
      {"sw-sort", "in/a.sgy --key=-channel -o {}", "out.sgy"},
      {"sw-filter", "in/a.sgy --band 5,10,30,40 -o {}", "out.sgy"},
      {"sw-diff", "in/a.sgy in/a.sgy -o {}", "out.sgy"},
      {"sw-spectrum", "in/a.sgy -o {}", "out.nc"},
      {"sw-spectrum", "in/a.sgy --fk --text -o {}", "out.txt"},
      {"sw-convert", "in/a.sgy --format ibm -o {}", "out.sgy"},
      {"sw-compare", "in/a.sgy in/a.sgy -o {}", "out.txt"},
      {"sw-plot", "in/m.nc -q -o {}", "out.png"},
      {"sw-plot", "in/a.sgy -q -o {}", "out.svg"},
      {"sw-plot", "in/s.nc -q --over in/m.nc -o {}", "out.pdf"},
      {"sw-info", "in/m.nc in/s.nc in/a.sgy", ""},
  };
}

std::string FaultScene::Command::to(const std::string& place) const {
  std::string line = tool + ' ' + arguments;
  if (const auto at = line.find("{}"); at != std::string::npos) line.replace(at, 2, place);
  return line;
}

std::string FaultScene::with_fault(const std::string& fault, const std::string& line) {
  return "LD_PRELOAD=" SLIPWAVE_SHIM " SLIPWAVE_FAULT=" + fault + " " + line;
}
