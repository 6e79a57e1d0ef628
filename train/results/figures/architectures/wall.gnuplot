# Run gnuplot on this file in its folder. Mean and standard error over seeds.
set datafile separator ','
set key outside right top Left reverse
set grid lc rgb '#dddddd'
set autoscale xfix
set format x '%g'
set xlabel 'wall clock (h)'
set ylabel 'distance in 10 s (m)' noenhanced
set title '' noenhanced
set terminal svg size 720,420 font 'sans,12' background rgb 'white'
set output './wall.svg'
plot './wall.csv' index 0 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#1b6ca8' fs transparent solid 0.1 noborder notitle, \
  '' index 0 using 1:2 with lines lw 2 lc rgb '#1b6ca8' title '2x64 (5 seeds)' noenhanced, \
  './wall.csv' index 1 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#d1495b' fs transparent solid 0.1 noborder notitle, \
  '' index 1 using 1:2 with lines lw 2 lc rgb '#d1495b' title '2x128 (5 seeds)' noenhanced, \
  './wall.csv' index 2 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#66a182' fs transparent solid 0.1 noborder notitle, \
  '' index 2 using 1:2 with lines lw 2 lc rgb '#66a182' title '3x128 (5 seeds)' noenhanced, \
  './wall.csv' index 3 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#edae49' fs transparent solid 0.1 noborder notitle, \
  '' index 3 using 1:2 with lines lw 2 lc rgb '#edae49' title '3x256 (5 seeds)' noenhanced, \
  './wall.csv' index 4 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#5d3a9b' fs transparent solid 0.1 noborder notitle, \
  '' index 4 using 1:2 with lines lw 2 lc rgb '#5d3a9b' title '5x128 (5 seeds)' noenhanced
unset output
set terminal pngcairo size 1440,840 font 'sans,20'
set output './wall.png'
plot './wall.csv' index 0 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#1b6ca8' fs transparent solid 0.1 noborder notitle, \
  '' index 0 using 1:2 with lines lw 2 lc rgb '#1b6ca8' title '2x64 (5 seeds)' noenhanced, \
  './wall.csv' index 1 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#d1495b' fs transparent solid 0.1 noborder notitle, \
  '' index 1 using 1:2 with lines lw 2 lc rgb '#d1495b' title '2x128 (5 seeds)' noenhanced, \
  './wall.csv' index 2 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#66a182' fs transparent solid 0.1 noborder notitle, \
  '' index 2 using 1:2 with lines lw 2 lc rgb '#66a182' title '3x128 (5 seeds)' noenhanced, \
  './wall.csv' index 3 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#edae49' fs transparent solid 0.1 noborder notitle, \
  '' index 3 using 1:2 with lines lw 2 lc rgb '#edae49' title '3x256 (5 seeds)' noenhanced, \
  './wall.csv' index 4 using 1:($2-$3):($2+$3) with filledcurves fc rgb '#5d3a9b' fs transparent solid 0.1 noborder notitle, \
  '' index 4 using 1:2 with lines lw 2 lc rgb '#5d3a9b' title '5x128 (5 seeds)' noenhanced
unset output
