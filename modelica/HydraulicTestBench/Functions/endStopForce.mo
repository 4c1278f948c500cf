within HydraulicTestBench.Functions;
function endStopForce "Force of an end stop, zero away from it, with a continuous slope at contact"
  extends Icons.Function;
  input Types.Length d "How far the body has gone beyond the stop, negative away from it";
  input Types.Velocity v "Velocity of the body into the stop";
  input Types.SpringConstant k_stop "Stiffness of the stop";
  input Types.DampingConstant d_stop "Damping of the stop";
  input Types.Length d_soft "Depth over which the stop takes hold, above 0";
  output Types.Force f "Force against the body, never negative: a stop does not pull";
protected
  Types.Length depth "Depth of penetration, 0 away from the stop";
  Real hold(unit="1") "Share of the stop's law in force, 0 ... 1";
algorithm
  depth := max(d, 0);
  hold := depth*depth/(depth*depth + d_soft*d_soft);
  f := max(hold*(k_stop*depth + d_stop*v), 0);
  annotation(Inline=true, Documentation(info="<html>
<p>A spring and a damper that take hold over the depth d<sub>soft</sub>:
f = max(0, h (k<sub>stop</sub> d + d<sub>stop</sub> v)) with h = d<sup>2</sup>/(d<sup>2</sup> +
d<sub>soft</sub><sup>2</sup>) for d &gt; 0. No event: the force and its slope start from zero at contact.</p>
<p><b>Source:</b> this library; the thesis has no end stops but hints at one (Section 4.1: the flow stops growing near
95 percent).</p>
<p><b>Valid:</b> any depth and speed.</p>
<p><b>Leaves out:</b> losses of the material beyond a linear damper.</p>
</html>"));
end endStopForce;
