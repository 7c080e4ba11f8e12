# What bench-edge-grid prints, as a chart: gnuplot -e "table='FILE'" bench/edge_grid.gp >FILE.svg
set terminal svg size 900,500 font "sans-serif,14" background rgb "white"
set logscale xy
set xrange [10:200000]
set xlabel "silhouette edges"
set ylabel "processor time, ms"
set grid
set key left top
# Rows of a scene: R/d .03 with 128 and 64 tiles a side at most, then .10 with both.
plot table skip 1 every 4::2 using 3:10 with points pt 7 ps .8 lc rgb "#d55e00" title "R/d .10", \
	table skip 1 every 4::0 using 3:10 with points pt 7 ps .8 lc rgb "#0072b2" title "R/d .03", \
	table skip 1 every 4::0 using 3:9 with points pt 6 ps .8 lc rgb "#4c4c4c" title "silhouettes alone", \
	x * 1e-3 with lines dt 2 lc rgb "#4c4c4c" title "1 µs an edge"
