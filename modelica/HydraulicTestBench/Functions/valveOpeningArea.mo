within HydraulicTestBench.Functions;
function valveOpeningArea "Opening area of one edge of the proportional valve, thesis Eq. 3.3"
  extends Icons.Function;
  input Types.SpoolPosition u "Spool opening; its sign does not matter, beyond 1 the edge is fully open";
  input Types.Area k1 "Cubic coefficient";
  input Types.Area k2 "Quadratic coefficient";
  input Types.Area k3 "Linear coefficient";
  output Types.Area K "Opening area, discharge coefficient included";
protected
  Real opening(unit="1") "Share of full opening, 0 ... 1";
algorithm
  opening := min(abs(u), 1);
  K := ((k1*opening + k2)*opening + k3)*opening;
  annotation(Inline=true, Documentation(info="<html>
<p>Third order polynomial of the spool opening, fitted by the thesis to the valve's data sheet:
K = k<sub>1</sub>|u|<sup>3</sup> + k<sub>2</sub>u<sup>2</sup> + k<sub>3</sub>|u|.</p>
<p><b>Source:</b> thesis Eq. 3.3; coefficients in Table 5.</p>
<p><b>Valid:</b> for |u| up to 1. Beyond that the area stays at K(1), because the cubic coefficient is negative and the
polynomial would close the valve again, and turn the flow round from |u| = 1.56.</p>
<p><b>Leaves out:</b> overlap and leakage of the closed edge. The slope jumps at u = 0, as it does in the equation.</p>
</html>"));
end valveOpeningArea;
