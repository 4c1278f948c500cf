within HydraulicTestBench.Data;
record StaticParameters "Known parameters of oil, supply and valve, thesis Table 5"
  extends Icons.Record;
  Types.BulkModulus beta = 1400e6 "Oil stiffness";
  Types.Density rho = 875 "Density of oil";
  Types.Angle alphaMAX = 15*Constants.pi/180 "Largest swash plate angle";
  Types.Pressure pS = 170e5 "Supply pressure of the angle control circuit";
  Types.Pressure pT = 0 "Tank pressure of the angle control circuit";
  Types.Area k1 = -4.67e-6 "Cubic coefficient of the valve opening";
  Types.Area k2 = 6.6454e-6 "Quadratic coefficient of the valve opening";
  Types.Area k3 = 0.967e-6 "Linear coefficient of the valve opening";
  annotation(Documentation(info="<html>
<p>What the thesis takes as known in all its simulations.</p>
<p><b>Source:</b> thesis Table 5 (Appendix E); names of its Table 6. pS is p<sub>P</sub> of Eq. 3.1.</p>
<p><b>Leaves out:</b> temperature; the values belong to warm oil on the thesis' bench.</p>
</html>"));
end StaticParameters;
