# SPDX-License-Identifier: BSD-3-Clause
# What the tables of bad input need beside them; run in an empty folder, where bad_models has put the models that no
# tool of ours would write.
set -eu
sw-layers --size 200x100 --step 5 --layer 0:1500:0:1000 --layer 60:3000:1500:2200 -o m.nc
sw-layers --size 200x100 --step 5 --layer 40:3000:1500:2200 -o void.nc
sw-layers --size 200x100 --step 5 --layer 0:3000:2500:2200 --allow-auxetic -o auxetic.nc
sw-layers --size 200x100 --step 5 --layer '0:3000:1500:2200 epsilon=0.2 delta=0.1' -o vti.nc
sw-layers --size 100x100x100 --step 10 --layer '0:3000:1500:2200 epsilon=0.2 delta=0.1' -o vti-cube.nc
sw-layers --size 100x80x60 --step 10 --layer 0:3000:1500:2200 -o cube.nc
printf '0 0 10\n50 0 10\n50 50 30\n0 50 10\n' > bent.txt
sw-layers --size 300x100 --step 10 --layer 0:2000:1000:2000 -o rock.nc
sw-layers --size 100x50 --step 5 --layer 0:2000:1000:2000 -o small.nc
sw-fracture rock.nc --segment 50,50:250,50 --faces --friction 0.5 --viscosity 0 --prestress=-1e4,-1e4,4e3 -o faulted.nc
sw-layers --size 200x400 --step 5 --layer 0:2000:1000:2000 |
  sw-fracture - --segment 50,45:150,45 --faces --compliance 1e-10,1e-10 -o cracked.nc
printf '0 50\n200 70\n' > sloping.txt
sw-layers -q --size 200x100 --step 5 --layer 0:1500:0:1000 --layer @sloping.txt:3000:1500:2200 -o sloping.nc
sw-layers -q --size 200x100 --step 5 --fit none --layer 0:2000:1000:2000 --layer @sloping.txt:3000:1500:2200 -o cut.nc
sw-layers -q --size 200x100 --step 5 --layer '0:2000:1000:2000 epsilon=0.2 delta=0.1 tilt=30' -o dipping-beds.nc
head -c 4000 m.nc > part.nc

shot='--wavelet ricker:10 --time 0.1'
# shellcheck disable=SC2086
{
  sw-shoot rock.nc --source 150,10 --receivers 0:300:100,10 $shot --record vx,vz -o a.sgy
  sw-shoot rock.nc --source 150,10 --receivers 0:300:100,10 $shot --record vx,vz --dt 0.002 -o coarse.sgy
  sw-shoot rock.nc --source 150,10 --receivers 0:300:50,10 $shot --record vx,vz -o more.sgy
  sw-shoot rock.nc --source 150,10 --receivers 0:300:100,20 $shot --record vx,vz -o deeper.sgy
  sw-shoot rock.nc --source 150,10 $shot --every 0.05 --snapshots s.nc
}
sw-select a.sgy --where 'channel!=2' -o uneven.sgy
sw-select a.sgy --where channel=1 -o one.sgy
sw-spectrum a.sgy -o spectrum.nc
sw-accuracy rock.nc --source 150,10 --wavelet ricker:10 --receivers 100,10 --time 0.05 --orders 1 --steps 10 \
  --reference 3,0.5,10 --cfls 0.9 -o table.nc > table.txt
head -c 5400 a.sgy > cut.sgy
head -c 3400 a.sgy > headless.sgy
head -c 4000 s.nc > cuts.nc

# change FILE COPY OFFSET BYTES: a copy with other bytes (octal) from the offset on.
change() {
  cp "$1" "$2"
  printf %b "$4" | dd of="$2" bs=1 seek="$3" conv=notrunc status=none
}
change a.sgy nan.sgy $((3600 + 644 + 240 + 64)) '\0177\0300\0000\0000'  # the 17th sample of the second trace
change a.sgy inf.sgy $((3600 + 240)) '\0177\0200\0000\0000'
change a.sgy no-format.sgy 3224 '\0000\0143'                            # sample format 99
change a.sgy gain.sgy 3224 '\0000\0004'                                 # fixed point with gain
change a.sgy still.sgy 3216 '\0000\0000'                                # no sampling interval in the file header
change still.sgy stills.sgy 3716 '\0000\0000'                           # nor in the first trace's

printf '\0\0\172\105%.0s' 1 2 3 4 > 4000.raw                        # four times 4000, little-endian
printf '\0\0\300\177%.0s' 1 2 3 4 > nan.raw
printf '\0\0\172\305%.0s' 1 2 3 4 > negative.raw
head -c 16 /dev/zero > zero.raw
: > empty
head -c 5000 /dev/zero | tr '\0' x > garbage
echo text > text
mkdir folder

lines() { file=$1; shift; printf '%s\n' "$@" > "$file"; }
lines own.csv x,z,kind,wavelet,amplitude 100,80,double-couple:30,ricker:10,2 120,50,explosion,ricker:12,1
lines two.txt '0 0' '10 10 # no third'
lines word.txt '0 0' '10 ten' '10 0'
lines well.txt 'DEPTH.M VP.M/S' '20 3000' '22 3050' '24 2990'
lines nulls.txt 'DEPTH.M VP.M/S VS.M/S RHO.G/CC' '0 2000 1000 2.1' '10 2100 9999 2.1' '20 2100 1000 2.1'
lines heights.txt 'DEPTH.M VP.M/S VS.M/S RHO.G/CC' '-10 2000 1000 2.1' '-20 2100 1000 2.1' '-30 2100 1000 2.1'
las() { # FILE DEPTH CURVE ROW
  lines "$1" '~Version' ' VERS. 2.0 : v' ' WRAP. NO : w' '~Well' " STRT.$2 100 : s" '~Curve' ' DEPT.FT : d' \
    ' DT.US/FT : p' " $3 : s" ' RHOB.G/CC : r' '~A' "$4" '110 100 200 2.2'
}
las shifted.las FT DTS.US/FT '100 100 200'
las units.las M DTS.US/FT '100 100 200 2.2'
las twice.las FT DT.US/FT '100 100 200 2.2'
lines early.csv 'x,z,delay' '100,50,-1e9'
lines three.txt '0 0' '10 10 10' '10 0'
lines bow.txt '0 0' '100 100' '100 0' '0 100'
lines line.txt '0 0' '50 50' '100 100'
lines top.txt '0 50' '100 60' '150 40'
lines back.txt '0 50' '100 60 # then back' '90 55' '200 50'
lines deep.txt '0 40' '100 80' '200 40'
lines fold.txt '0 50' '100 60' '100 40' '200 50'
lines grid.xyz '0 0 50' '200 0 60' '0 100 40' '200 100 55'
lines gap.xyz '# a corner is missing' '0 0 50' '200 0 60' '0 100 40'
lines double.xyz '0 0 50' '200 0 60' '0 100 40' '200 100 55' '200 0 61'
lines nan.xyz '0 0 50' '200 0 60' '0 100 NaN' '200 100 55'
lines word.xyz '0 0 50' '200 0 sixty'
lines columns.xyz '0 0 50' '200 0'
lines row.xyz '0 0 50' '100 0 60' '200 0 50'
lines scattered.xyz '0 0 50' '180 10 60' '30 90 40' '190 100 55' '90 60 50'
lines up.xyz '0 0 -50' '200 0 -60' '0 100 -40' '200 100 -55'
truncate -s 67108865 huge.xyz
lines nan.txt '0 50' '100 nan' '200 50'
lines w-nan.txt '0 0' '0.01 nan' '0.02 0'
lines w-inf.txt '0 0' '0.01 inf' '0.02 0'
lines w-back.txt '0 0' '0.02 1' '0.01 0'
lines w-one.txt '0 1'
lines w-zeros.txt '0 0' '0.01 0' '0.02 0'
lines w-columns.txt '0 0 0' '1 1 1'
lines w-dt.txt '# dt=0' '0' '1' '0'
lines w-late.txt '0 0' '# dt=0.1' '0.2 1'
lines misspelt.cfg 'sise = 200x100'
lines bare.cfg 'size'
lines twice.cfg 'step = 1' 'step = 2'
lines five.cfg 'step = five'
lines help.cfg 'help = true'
lines maybe.cfg 'allow-auxetic = maybe'
lines shoot.cfg 'tme = 1'
lines order.cfg 'order = 4'
head -c 300 /dev/zero > zero.cfg
ln -s nowhere.nc dangling.nc
ln -s loop.nc loop.nc
